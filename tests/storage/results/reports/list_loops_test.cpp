#include <gmock/gmock.h>

#include "storage/results/catalogue/catalogue.hpp"
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
  [[nodiscard]] std::vector<LoopRow> list() const {
    return ReportDatabase(settings_for(*database)).loops();
  }
  [[nodiscard]] LoopRow find(const std::string& name) const {
    for (const LoopRow& loop : list())
      if (loop.name == name) return loop;
    return {};
  }
};

TEST_F(ListLoopsTest, TellsTheStateOfEachAndWhyItIsNotListed) {
  std::vector<std::string> states;
  for (const LoopRow& loop : list()) states.push_back(loop.name + ": " + loop.state);
  EXPECT_EQ(states.at(0) + ", " + states.at(1), "FIC1: flagged, FIC2: flagged");
  EXPECT_THAT(std::vector(states.begin() + 2, states.end()),
              testing::UnorderedElementsAre("TIC4: off the list", "lic3: not flagged",
                                            "new: never analysed", "off: disabled"));
  EXPECT_THAT(find("TIC4").hidden_by, Optional(StartsWith("not sure enough for the list (prob")));
  EXPECT_THAT(find("off").hidden_by, Optional(std::string("disabled")));
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

}  // namespace
}  // namespace loopscope::storage
