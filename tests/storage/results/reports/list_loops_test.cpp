#include <chrono>
#include <gmock/gmock.h>
#include <thread>

#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// Every loop of the catalogue with its place on the lists and in the orders of the database.
namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::Optional;
using testing::StartsWith;

class ListLoopsTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    tell({{.loop = "FIC1"},
          {.loop = "FIC2", .confidence = 0.9, .slot_hours = 2},
          {.loop = "lic3", .code = VerdictCode::healthy, .confidence = 0.7},
          {.loop = "TIC4", .code = VerdictCode::tight_tuning, .confidence = 0.1},
          {.loop = "off", .confidence = 0.8}});
    add_loops({"new"});
    database->execute(
        "UPDATE loopscope.loop SET area = 'north', description = 'Reflux', owner = 'Dr. Meier'"
        " WHERE name IN ('FIC1', 'lic3');"
        "UPDATE loopscope.loop SET area = 'South', unit = 'crude' WHERE name = 'FIC2'");
    Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  }
  [[nodiscard]] ListedLoops list() const { return ReportDatabase(settings_for(*database)).loops(); }
  /// Its texts last until the next call.
  [[nodiscard]] LoopRow find(const std::string& name) {
    found_ = list();
    for (const LoopRow loop : found_)
      if (loop.name == name) return loop;
    return {};
  }

 private:
  ListedLoops found_;
};

TEST_F(ListLoopsTest, TellsTheStateOfEachAndWhyItIsNotListed) {
  std::vector<std::string> states;
  for (const LoopRow loop : list())
    states.push_back(std::string(loop.name) + ": " + std::string(loop.state));
  EXPECT_EQ(states.at(0) + ", " + states.at(1), "FIC1: flagged, FIC2: flagged");
  EXPECT_THAT(std::vector(states.begin() + 2, states.end()),
              testing::UnorderedElementsAre("TIC4: off the list", "lic3: not flagged",
                                            "new: never analysed", "off: disabled"));
  EXPECT_THAT(find("TIC4").hidden_by, Optional(StartsWith("not sure enough for the list (prob")));
  EXPECT_THAT(find("off").hidden_by, Optional(std::string_view("disabled")));
  EXPECT_EQ(find("lic3").hidden_by, std::nullopt);
  EXPECT_EQ(find("FIC1").rank, 1);
  EXPECT_EQ(find("FIC1").status, "watch");
  EXPECT_EQ(find("FIC1").health, "ok");
  EXPECT_EQ(find("new").confidence, std::nullopt);
}

TEST_F(ListLoopsTest, TellsWhoTookAFaultOffTheList) {
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged'"
      " FROM loopscope.loop WHERE name = 'FIC1'");
  EXPECT_EQ(find("FIC1").state, "off the list");
  EXPECT_EQ(find("FIC1").hidden_by, "annotated");
  EXPECT_EQ(find("FIC1").rank, std::nullopt);
  EXPECT_EQ(find("FIC2").rank, 1);
}

/// Places are those of the database's collation, whatever the case.
TEST_F(ListLoopsTest, TellsTheDatabasesOrderAndSmallLetters) {
  EXPECT_LT(find("FIC2").name_place, find("lic3").name_place);
  EXPECT_LT(find("lic3").name_place, find("TIC4").name_place);
  EXPECT_EQ(find("FIC1").area_place, find("lic3").area_place);
  EXPECT_LT(find("FIC1").area_place, find("FIC2").area_place);
  EXPECT_EQ(find("TIC4").area_place, std::nullopt);
  EXPECT_EQ(find("TIC4").unit_place, std::nullopt);
  EXPECT_EQ(find("FIC1").searched, "fic1 reflux dr. meier");
  ReportDatabase database_of(settings_for(*database));
  EXPECT_EQ(database_of.in_small_letters("reFLUX"), "reflux");
  EXPECT_EQ(database_of.in_small_letters("\xff"), "") << "no text of the database can hold it";
}

/// Two thousand loops of which all that is known is known of "member" as well.
constexpr const char* kTwins = R"(
    INSERT INTO loopscope.loop (name, source, sp_tag, pv_tag, op_tag, interval_s, period_s)
    SELECT name || i, source, sp_tag, pv_tag, op_tag, interval_s, period_s
    FROM loopscope.loop CROSS JOIN generate_series(1, 2000) AS i WHERE name = 'member';
    UPDATE loopscope.schedule SET result_slot_end = known.result_slot_end,
                                  last_slot_end = known.last_slot_end
    FROM loopscope.schedule AS known JOIN loopscope.loop USING (loop_id)
    WHERE loop.name = 'member' AND schedule.loop_id > known.loop_id;
    INSERT INTO loopscope.analysis
    SELECT (jsonb_populate_record(known, jsonb_build_object('loop_id', twin.loop_id, 'analysis_id',
                                                            1000000 + twin.loop_id))).*
    FROM loopscope.analysis AS known JOIN loopscope.loop USING (loop_id)
    JOIN loopscope.loop AS twin ON twin.loop_id > known.loop_id WHERE loop.name = 'member';
    INSERT INTO loopscope.verdict
    SELECT (jsonb_populate_record(known, jsonb_build_object('loop_id', twin.loop_id, 'analysis_id',
                                                            1000000 + twin.loop_id))).*
    FROM loopscope.verdict AS known JOIN loopscope.loop USING (loop_id)
    JOIN loopscope.loop AS twin ON twin.loop_id > known.loop_id WHERE loop.name = 'member')";

/// Once a loop would be the square of the plant's size: the events of a large plant have thousands
/// of members.
TEST_F(ListLoopsTest, ReadsSharedOscillationsOnceWhateverTheNumberOfLoops) {
  tell({{.loop = "member", .code = VerdictCode::healthy}});
  database->execute(kTwins);
  PlantEvent event;
  event.period_s = 40.0;
  event.p = 0.001;
  for (const std::string& id :
       column("SELECT loop_id FROM loopscope.loop WHERE name LIKE 'member%'"))
    event.members.push_back({std::stoll(id), "member", 0.25, 3.0, 0.5});
  PlantRounds(settings_for(*database)).store({slot(1), 1, 2000, 2000, {event}});
  database->execute("ANALYZE");
  const auto scans = [&] {
    return std::stoll(
        value("SELECT seq_scan + coalesce(idx_scan, 0) FROM pg_stat_user_tables"
              " WHERE relname = 'plant_oscillation'"));
  };
  const auto before = scans();
  EXPECT_EQ(find("member1007").follows.value_or("").substr(0, 4), "25 %");
  ReportDatabase twice(settings_for(*database));
  EXPECT_EQ(twice.loops().size(), 2007U);
  const ListedLoops again = twice.loops();
  ASSERT_EQ(again.size(), 2007U) << "more than one piece of two thousand";
  std::vector<std::string> names;
  for (const LoopRow loop : again)
    if (!loop.rank) names.emplace_back(loop.name);
  EXPECT_EQ(names, column("SELECT name FROM loopscope.loop WHERE name NOT IN ('FIC1', 'FIC2')"
                          " ORDER BY name"));
  // A session's scans are counted when it has ended.
  for (int look = 0; look < 100 && scans() == before; ++look)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GT(scans(), before);
  EXPECT_LT(scans(), before + 20);
}

}  // namespace
}  // namespace loopscope::storage
