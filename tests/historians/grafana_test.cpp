#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"
#include "tests/support/grafana_macros.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

/// The queries of the panel "Raw signals": that of the dashboard, and those of deploy/grafana/
/// README.md for other tables.
namespace loopscope::tests {
namespace {

constexpr int kRecorded = 600;

std::string of_dashboard() {
  std::ifstream file(source_dir() / "deploy" / "grafana" / "loopscope.json");
  const nlohmann::json dashboard = nlohmann::json::parse(file);
  for (const nlohmann::json& panel : dashboard["panels"])
    if (panel["title"] == "Raw signals") return panel["targets"][1]["rawSql"];
  throw std::runtime_error("the dashboard has no panel of raw signals");
}

/// The statement below that heading.
std::string of_readme(const std::string& heading) {
  const std::string text = content_of(source_dir() / "deploy" / "grafana" / "README.md");
  const std::string begin = "```sql\n";
  const std::size_t section = text.find("### " + heading + "\n");
  if (section == std::string::npos) throw std::runtime_error("no heading " + heading);
  const std::size_t from = text.find(begin, section) + begin.size();
  return text.substr(from, text.find("\n```", from) - from);
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

std::string statement_of(const Vendor& vendor) {
  const std::string name = vendor.name;
  if (name == "narrow") return of_dashboard();
  if (name == "timescale_narrow") return of_readme("narrow, tags by number");
  std::string statement = of_readme(vendor.preset);
  if (name == "telegraf_keys") {
    replace_all(statement, "WHERE loop = ",
                "WHERE tag_id = (SELECT tag_id FROM public.control_tag WHERE loop = ");
    replace_all(statement, " AND $__timeFilter", ") AND $__timeFilter");
  }
  return statement;
}

class RawSignals : public testing::TestWithParam<Vendor> {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
  }
};
INSTANTIATE_TEST_SUITE_P(Vendors, RawSignals, testing::ValuesIn(vendors()),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

TEST_P(RawSignals, AreTheRowsOfTheTimeRange) {
  const TestDatabase database;
  const Truth truth(database, 2, kRecorded);
  database.execute(GetParam().tables);
  if (std::string(GetParam().preset) == "ignition")
    database.execute(
        "CREATE VIEW public.recent AS SELECT * FROM sqlt_data_1_2026_02"
        " UNION ALL SELECT * FROM sqlt_data_2_2026_03");
  // From between two rows to between two others: 20 of them.
  const std::int64_t from_s = Truth::time_us(500) / 1'000'000 - 5;
  const std::int64_t to_s = Truth::time_us(519) / 1'000'000 + 5;
  for (const char* role : {"sp", "pv", "op"}) {
    std::string statement = statement_of(GetParam());
    replace_all(statement, "pv_tag", std::string(role) + "_tag");
    replace_all(statement, "AS pv", std::string("AS ") + role);
    statement = expand_macros(
        with_variable(statement, std::string(role) + "_tag", tag_of(GetParam(), 2, role)), from_s,
        to_s);
    const TextRows rows =
        database.rows("SELECT (extract(epoch FROM \"time\") * 1000000)::bigint, " +
                      std::string(role) + " FROM (" + statement + ") AS panel");
    const auto expected = truth.rows(2, role, 500, 519);
    ASSERT_EQ(rows.size(), expected.size()) << statement;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_EQ(std::stoll(rows[k][0]), expected[k].time_us) << role << k;
      EXPECT_EQ(std::strtod(rows[k][1].c_str(), nullptr), expected[k].value) << role << k;
    }
  }
}

}  // namespace
}  // namespace loopscope::tests
