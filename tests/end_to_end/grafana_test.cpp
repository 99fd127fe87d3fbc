#include <algorithm>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>

#include "tests/end_to_end/told_plant.hpp"

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

/// What Grafana makes of its macros, for the last 45 days and a loop of that name. A macro that is
/// not known here stays and makes the statement fail.
std::string expanded(std::string statement, const std::string& loop) {
  const auto replace = [&](const char* macro, const std::string& text) {
    statement = std::regex_replace(statement, std::regex(macro), text);
  };
  replace(R"(\$__timeFilter\(([^)]*)\))", "$1 BETWEEN now() - interval '45 days' AND now()");
  replace(R"(\$__timeFrom\(\))", "(now() - interval '45 days')");
  replace(R"(\$__timeTo\(\))", "now()");
  replace(R"(\$\{loop:sqlstring\})", "'" + loop + "'");
  return statement;
}

std::vector<std::string> statements(const Json& board) {
  std::vector<std::string> found = values_of(board, "rawSql");
  for (const Json& variable : board["templating"]["list"])
    if (variable["type"] == "query") found.push_back(variable["query"]);
  return found;
}

TEST(GrafanaDashboard, EveryQueryRunsAsAReaderAndHasSomethingToShow) {
  const ToldPlant plant;
  const std::vector<std::string> all = statements(dashboard());
  EXPECT_GT(all.size(), 20U);
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
  // Grafana doubles the quotes of ${loop:sqlstring}; nothing else may stand for the loop.
  const std::vector<std::string> all = statements(dashboard());
  EXPECT_TRUE(std::ranges::any_of(all, [](const std::string& statement) {
    return statement.find("${loop:sqlstring}") != std::string::npos;
  }));
  for (const std::string& statement : all) {
    EXPECT_EQ(statement.find("$loop"), std::string::npos) << statement;
    EXPECT_EQ(statement.find("${loop}"), std::string::npos) << statement;
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

/// The page of figures of a daemon, once it shows a whole batch and the state of the plant, which
/// is read beside it; the log says where it is.
std::string scraped(const std::string& log) {
  const std::regex address("http://[0-9.:]+");
  for (int tries = 0; tries < 300; ++tries) {
    const std::string lines = content_of(log);
    std::smatch found;
    if (std::regex_search(lines, found, address)) {
      const ProgramResult page = run_program({"/usr/bin/curl", "-sf", found.str() + "/metrics"});
      if (shows(page.out, "loopscope_batch_seconds_bucket") &&
          shows(page.out, "loopscope_lag_seconds"))
        return page.out;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return "";
}

/// Every metric, and every label that the page shows beside one.
TEST(GrafanaDashboard, EveryMetricIsExported) {
  const Plant plant;
  plant.write_settings(Plant::settings(R"("daemon": {"http_address": "127.0.0.1:0"})"));
  plant.import_loop("FIC101");
  const std::string log = plant.folder() / "run.log";
  BackgroundProgram daemon(plant.command_line("run"), log);
  const std::string page = scraped(log);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(60), 0);
  ASSERT_THAT(page, Not(IsEmpty())) << content_of(log);
  const std::vector<std::string> expressions = values_of(dashboard(), "expr");
  EXPECT_GT(expressions.size(), 10U);
  const std::regex name("loopscope_[a-z_]+"), label(R"(by \(([a-z_]+)\))");
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
