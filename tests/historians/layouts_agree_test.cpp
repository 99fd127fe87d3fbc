#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

constexpr const char* kLayouts[] = {"narrow",   "loop_row",    "wide",
                                    "ignition", "thingsboard", "telegraf"};
constexpr int kLoops = 2;

/// One settings file with six historians in one database.
class LayoutsAgree : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    database.emplace();
    const Truth truth(*database, kLoops, 6'000);
    nlohmann::json historians = nlohmann::json::array();
    for (const char* name : kLayouts) {
      database->execute(vendor(name).tables);
      historians.push_back(site(vendor(name)));
    }
    const nlohmann::json settings = {
        {"results", {{"connection", database->conninfo(database->owner())}}},
        {"historians", historians}};
    std::ofstream(file()) << settings.dump(2);
  }

  nlohmann::json site(const Vendor& vendor) {
    nlohmann::json json = {
        {"name", vendor.name}, {"preset", vendor.preset}, {"connection", database->conninfo()}};
    config::HistorianSettings historian;
    vendor.site(historian);
    if (historian.table != config::HistorianSettings{}.table) json["table"] = historian.table;
    if (vendor.preset == std::string("telegraf")) json["tag_column"] = historian.tag_column;
    return json;
  }

  std::string file() const { return folder.path() / "loopscope.json"; }

  ProgramResult loopscope(std::vector<std::string> words) const {
    words.insert(words.begin(), LOOPSCOPE_PROGRAM);
    words.insert(words.begin() + 2, {"--config", file()});
    return run_program(words);
  }

  TemporaryFolder folder;
  std::optional<TestDatabase> database;
};

TEST_F(LayoutsAgree, OnIndicesAndVerdicts) {
  ASSERT_EQ(loopscope({"migrate"}).exit_code, 0);
  const std::string csv = folder.path() / "loops.csv";
  {
    std::ofstream loops(csv);
    loops << "name,source,sp_tag,pv_tag,op_tag,interval_s\n";
    for (const char* name : kLayouts) {
      for (int loop = 1; loop <= kLoops; ++loop) {
        loops << name << ' ' << loop << ',' << name;
        for (const char* role : {"sp", "pv", "op"}) {
          loops << ',' << tag_of(vendor(name), loop, role);
        }
        loops << ",10\n";
      }
    }
  }
  const ProgramResult loaded = loopscope({"loops", "load", csv});
  ASSERT_EQ(loaded.exit_code, 0) << loaded.err;
  const ProgramResult once = loopscope({"once"});
  ASSERT_EQ(once.exit_code, 0) << once.err;
  for (int loop = 1; loop <= kLoops; ++loop) {
    // Everything that an analysis says, but whose it is, when it was made and how long it took.
    const auto answers = database->rows(
        "SELECT DISTINCT (to_jsonb(a) - "
        "'{loop_id,analysis_id,analysed_at,fetch_ms,analyse_ms,prepare_ms,statistics_ms,model_ms}':"
        ":text[])::text,"
        " (to_jsonb(v) - '{loop_id,analysis_id,decided_at}'::text[])::text"
        " FROM loopscope.analysis AS a JOIN loopscope.verdict AS v USING (loop_id)"
        " JOIN loopscope.loop USING (loop_id) WHERE loop.name LIKE '% " +
        std::to_string(loop) + "'");
    EXPECT_EQ(answers.size(), 1U) << "of six layouts";
    if (answers.size() > 1) {
      ADD_FAILURE() << answers[0][0] << '\n'
                    << answers[1][0] << '\n'
                    << answers[0][1] << '\n'
                    << answers[1][1];
    }
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.analysis WHERE usable"), "12");
}

}  // namespace
}  // namespace loopscope::tests
