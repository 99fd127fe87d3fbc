#include <algorithm>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>

#include "tests/end_to_end/told_plant.hpp"
#include "tests/support/grafana_macros.hpp"

/// deploy/grafana/loopscope.json: every query of it runs on the schema of this program, and every
/// metric that it draws is one that this program exports.
namespace loopscope::tests {
namespace {

using Json = nlohmann::json;
using testing::IsEmpty;
using testing::Not;

Json dashboard() {
  std::ifstream file(source_dir() / "deploy" / "grafana" / "loopscope.json");
  return Json::parse(file);
}

/// Every value of this key, wherever it stands.
std::vector<std::string> values_of(const Json& part, const std::string& key) {
  std::vector<std::string> found;
  for (const auto& [name, value] : part.items()) {
    if (part.is_object() && name == key && value.is_string()) found.push_back(value);
    if (!value.is_structured()) continue;
    const std::vector<std::string> inner = values_of(value, key);
    found.insert(found.end(), inner.begin(), inner.end());
  }
  return found;
}

/// For the last 45 days and a loop of that name.
std::string expanded(const std::string& statement, const std::string& loop) {
  const auto now_s = static_cast<std::int64_t>(std::time(nullptr)) + 1;  // what is new as well
  return expand_macros(with_variable(statement, "loop", loop), now_s - std::int64_t{45} * 86'400,
                       now_s);
}

/// The statements for the source of that variable.
std::vector<std::string> statements(const Json& board, const std::string& source = "results") {
  std::vector<std::string> found;
  const auto take = [&](const Json& target, const char* key) {
    if (target["datasource"]["uid"] == "${" + source + "}") found.push_back(target[key]);
  };
  for (const Json& panel : board["panels"])
    for (const Json& target : panel.value("targets", Json::array()))
      if (target.contains("rawSql")) take(target, "rawSql");
  for (const Json& repair : board["annotations"]["list"]) take(repair["target"], "rawSql");
  for (const Json& variable : board["templating"]["list"])
    if (variable["type"] == "query") take(variable, "query");
  return found;
}

/// A variable as Grafana fills it for that loop.
std::string variable_of(const Json& board, const std::string& name, const std::string& loop,
                        const Plant& plant) {
  for (const Json& variable : board["templating"]["list"])
    if (variable["name"] == name) return plant.sql(with_variable(variable["query"], "loop", loop));
  throw std::runtime_error("no variable " + name);
}

TEST(GrafanaDashboard, EveryQueryRunsAsAReaderAndHasSomethingToShow) {
  const ToldPlant plant;
  const std::vector<std::string> all = statements(dashboard());
  EXPECT_GT(all.size(), 20U);
  EXPECT_EQ(all.size() + statements(dashboard(), "historian").size(),
            values_of(dashboard(), "rawSql").size() + 4)
      << "with the variables, none is left out";
  for (const std::string& statement : all) {
    std::string shown;
    for (const char* loop : {"FIC101", "TIC400"}) {
      const ProgramResult result = plant.ask("loopscope_reader", expanded(statement, loop));
      EXPECT_EQ(result.exit_code, 0) << statement << "\n" << result.err;
      shown += result.out;
    }
    EXPECT_THAT(shown, Not(IsEmpty())) << statement;
  }
}

TEST(GrafanaDashboard, ANameWithAQuoteIsNoSql) {
  // Grafana doubles the quotes of ${loop:sqlstring}; nothing else may stand for loop or tag.
  std::vector<std::string> all = statements(dashboard());
  for (const std::string& statement : statements(dashboard(), "historian")) {
    EXPECT_NE(statement.find("_tag:sqlstring}"), std::string::npos) << statement;
    all.push_back(statement);
  }
  EXPECT_TRUE(std::ranges::any_of(all, [](const std::string& statement) {
    return statement.find("${loop:sqlstring}") != std::string::npos;
  }));
  for (const std::string& statement : all) {
    EXPECT_EQ(statement.find("$loop"), std::string::npos) << statement;
    EXPECT_EQ(statement.find("${loop}"), std::string::npos) << statement;
    EXPECT_EQ(statement.find("_tag}"), std::string::npos) << statement;
    EXPECT_EQ(statement.find("$sp_tag"), std::string::npos) << statement;
  }
}

TEST(GrafanaDashboard, PanelsDoNotOverlapAndNameTheirAxes) {
  std::set<int> ids;
  std::set<std::pair<int, int>> taken;
  const Json board = dashboard();
  for (const Json& panel : board["panels"]) {
    SCOPED_TRACE(panel["title"]);
    EXPECT_TRUE(ids.insert(panel["id"].get<int>()).second);
    const Json& place = panel["gridPos"];
    for (int x = place["x"]; x < place["x"].get<int>() + place["w"].get<int>(); ++x)
      for (int y = place["y"]; y < place["y"].get<int>() + place["h"].get<int>(); ++y)
        EXPECT_TRUE(x < 24 && taken.insert({x, y}).second) << x << ", " << y;
    if (panel["type"] == "timeseries") {
      EXPECT_THAT(panel["fieldConfig"]["defaults"]["custom"]["axisLabel"].get<std::string>(),
                  Not(IsEmpty()));
    }
  }
  EXPECT_GT(ids.size(), 5U);
}

bool shows(const std::string& page, const char* metric) {
  return page.find(metric) != std::string::npos;
}

/// The page of figures of a daemon, once it shows a whole batch and the state of schedule and
/// plant, which are read beside it; the log says where it is.
std::string scraped(const std::string& log) {
  const std::regex address("http://[0-9.:]+");
  for (int tries = 0; tries < 300; ++tries) {
    const std::string lines = content_of(log);
    std::smatch found;
    if (std::regex_search(lines, found, address)) {
      const ProgramResult page = run_program({"/usr/bin/curl", "-sf", found.str() + "/metrics"});
      if (shows(page.out, "loopscope_batch_seconds_bucket") &&
          shows(page.out, "loopscope_lag_seconds") && shows(page.out, "loopscope_service_factor"))
        return page.out;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return "";
}

/// As the source "Historian" asks: of the newest window, with the rights that it needs.
void expect_raw_signals(const Plant& plant, const std::string& loop) {
  const Json board = dashboard();
  const std::vector<std::string> all = statements(board, "historian");
  ASSERT_EQ(all.size(), 3U);
  plant.sql("GRANT SELECT ON public.history TO loopscope_historian");
  for (std::string statement : all) {
    for (const char* variable : {"sp_tag", "pv_tag", "op_tag"})
      statement = with_variable(statement, variable, variable_of(board, variable, loop, plant));
    const std::string rows =
        plant.sql("SET ROLE loopscope_historian; " + expanded(statement, loop));
    plant.sql("RESET ROLE");
    EXPECT_EQ(std::ranges::count(rows, '\n'), 4095) << statement;
  }
}

/// Every metric, and every label that the page shows beside one.
TEST(GrafanaDashboard, EveryMetricIsExportedAndTheHistorianShowsTheWindow) {
  const Plant plant;
  plant.write_settings(Plant::settings(R"("daemon": {"http_address": "127.0.0.1:0"})"));
  plant.import_loop("FIC101", 4096);
  expect_raw_signals(plant, "FIC101");
  EXPECT_EQ(plant.loopscope("once").exit_code, 0);  // known from the first look on
  plant.import_loop("FIC102");
  const std::string log = plant.folder() / "run.log";
  BackgroundProgram daemon(plant.command_line("run"), log);
  const std::string page = scraped(log);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(60), 0);
  ASSERT_THAT(page, Not(IsEmpty())) << content_of(log);
  const std::vector<std::string> expressions = values_of(dashboard(), "expr");
  EXPECT_GT(expressions.size(), 10U);
  const std::regex name("loopscope_[a-z_]+"), label(R"((?:by \(|, )([a-z_]+)(?=[,)]))");
  for (const std::string& expression : expressions) {
    std::smatch found;
    for (std::string rest = expression; std::regex_search(rest, found, name); rest = found.suffix())
      EXPECT_NE(page.find("# TYPE " + std::regex_replace(found.str(), std::regex("_bucket$"), "")),
                std::string::npos)
          << found.str();
    // `job` is Prometheus's own label.
    for (std::string rest = expression; std::regex_search(rest, found, label);
         rest = found.suffix())
      EXPECT_TRUE(found[1] == "job" || page.find(found[1].str() + "=\"") != std::string::npos)
          << expression;
  }
}

}  // namespace
}  // namespace loopscope::tests
