#include <gmock/gmock.h>

#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// Pages of the catalogue's loops: what fits, in which order, and how many there are.
namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::IsEmpty;

class ListLoopsTest : public ViewsTest {
 protected:
  void SetUp() override {
    ViewsTest::SetUp();
    tell({{.loop = "FIC1"},
          {.loop = "FIC2", .confidence = 0.9, .slot_hours = 2},
          {.loop = "LIC3", .code = VerdictCode::healthy, .confidence = 0.7},
          {.loop = "TIC4", .code = VerdictCode::tight_tuning, .confidence = 0.1},
          {.loop = "off", .code = VerdictCode::healthy, .confidence = 0.8}});
    add_loops({"new"});
    database->execute(
        "UPDATE loopscope.loop SET area = 'north', description = 'Reflux', owner = 'Dr. Meier'"
        " WHERE name IN ('FIC1', 'LIC3');"
        "UPDATE loopscope.loop SET area = 'South', unit = 'crude' WHERE name = 'FIC2'");
    Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  }
  [[nodiscard]] LoopListing list(LoopQuery query) const {
    if (query.most == 0) query.most = 100;
    return ReportDatabase(settings_for(*database)).loops(query);
  }
  [[nodiscard]] std::vector<std::string> names(const LoopQuery& query) const {
    std::vector<std::string> found;
    for (const LoopRow& loop : list(query).loops) found.push_back(loop.name);
    return found;
  }
};

TEST_F(ListLoopsTest, FindsByAreaUnitVerdictStateAndWords) {
  EXPECT_THAT(names({.area = "north"}), ElementsAre("FIC1", "LIC3"));
  EXPECT_THAT(names({.unit = "crude"}), ElementsAre("FIC2"));
  EXPECT_THAT(names({.verdict = "healthy"}), ElementsAre("LIC3", "off"));
  EXPECT_THAT(names({.verdict = "none"}), ElementsAre("new"));
  EXPECT_THAT(names({.state = "flagged"}), ElementsAre("FIC1", "FIC2"));
  EXPECT_THAT(names({.state = "off the list"}), ElementsAre("TIC4"));
  EXPECT_THAT(names({.state = "not flagged"}), ElementsAre("LIC3"));
  EXPECT_THAT(names({.state = "never analysed"}), ElementsAre("new"));
  EXPECT_THAT(names({.state = "disabled"}), ElementsAre("off"));
  EXPECT_THAT(names({.part = "ic"}), ElementsAre("FIC1", "FIC2", "LIC3", "TIC4"));
  EXPECT_THAT(names({.part = "refLUX"}), ElementsAre("FIC1", "LIC3"));
  EXPECT_THAT(names({.part = "meier", .state = "flagged"}), ElementsAre("FIC1"));
  EXPECT_THAT(names({.part = "%"}), IsEmpty()) << "words, no pattern";
  EXPECT_THAT(names({.part = std::string("\0\xff", 2)}), IsEmpty());
}

/// What has none of what the order goes by stands behind, whichever way.
TEST_F(ListLoopsTest, InEveryOrderAndBackwards) {
  EXPECT_THAT(names({}), ElementsAre("FIC1", "FIC2", "LIC3", "TIC4", "new", "off"));
  EXPECT_THAT(names({.order = LoopOrder::name, .backwards = true}),
              ElementsAre("TIC4", "off", "new", "LIC3", "FIC2", "FIC1"));
  EXPECT_THAT(names({.part = "IC", .order = LoopOrder::area}),
              ElementsAre("FIC1", "LIC3", "FIC2", "TIC4"));
  EXPECT_THAT(names({.part = "IC", .order = LoopOrder::area, .backwards = true}),
              ElementsAre("FIC2", "FIC1", "LIC3", "TIC4"));
  EXPECT_THAT(names({.order = LoopOrder::confidence}),
              ElementsAre("FIC1", "FIC2", "off", "LIC3", "TIC4", "new"));
  EXPECT_THAT(names({.order = LoopOrder::confidence, .backwards = true}),
              ElementsAre("TIC4", "LIC3", "off", "FIC2", "FIC1", "new"));
  EXPECT_THAT(names({.order = LoopOrder::verdict}),
              ElementsAre("LIC3", "off", "TIC4", "FIC1", "FIC2", "new"));
  EXPECT_EQ(names({.order = LoopOrder::window}).front(), "FIC2");
}

TEST_F(ListLoopsTest, PagesHoldEveryLoopOnce) {
  std::vector<std::string> seen;
  for (const std::int64_t skip : {0, 4, 8}) {
    const LoopListing page = list({.order = LoopOrder::state, .skip = skip, .most = 4});
    EXPECT_EQ(page.all, 6);
    EXPECT_EQ(page.fitting, 6) << "on all pages, also where none is left for this one";
    for (const LoopRow& loop : page.loops) seen.push_back(loop.name);
  }
  EXPECT_THAT(seen, testing::UnorderedElementsAre("FIC1", "FIC2", "LIC3", "TIC4", "new", "off"));
  const LoopListing none = list({.area = "west"});
  EXPECT_EQ(none.fitting, 0);
  EXPECT_EQ(none.all, 6);
}

TEST_F(ListLoopsTest, OffersWhatLoopsHave) {
  const LoopListing page = list({.area = "north"});
  EXPECT_THAT(page.areas, testing::UnorderedElementsAre("north", "South"));
  EXPECT_THAT(page.units, ElementsAre("crude"));
  EXPECT_THAT(page.verdicts, ElementsAre("healthy", "tight_tuning", "valve_stiction", "none"));
  EXPECT_EQ(page.states, loop_states());
  EXPECT_EQ(page.loops.front().description, "Reflux");
  EXPECT_EQ(page.loops.front().health, "ok");
}

}  // namespace
}  // namespace loopscope::storage
