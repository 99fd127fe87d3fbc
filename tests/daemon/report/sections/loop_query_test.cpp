#include "daemon/report/sections/loop_query.hpp"

#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// Pages of the catalogue's loops: what fits, in which order, and how many there are.
namespace loopscope::daemon {
namespace {

using storage::LoopRow;
using testing::ElementsAre;
using testing::IsEmpty;

struct Known {
  std::int64_t place = 0;
  std::string_view name, searched, code, state;
};

LoopRow loop(const Known& known) {
  LoopRow row;
  row.name_place = known.place;
  row.name = known.name;
  row.searched = known.searched;
  if (!known.code.empty()) row.code = row.shown_code = known.code;
  row.state = known.state;
  return row;
}

/// By rank and name, as the database gives them.
storage::ListedLoops made_plant() {
  std::vector<LoopRow> loops = {loop({1, "FIC1", "fic1 reflux", "valve_stiction", "flagged"}),
                                loop({2, "FIC2", "fic2 reflux", "valve_stiction", "flagged"}),
                                loop({3, "LIC3", "lic3 reflux", "healthy", "not flagged"}),
                                loop({6, "TIC4", "tic4 reflux", "tight_tuning", "off the list"}),
                                loop({4, "new", "new reflux", "", "never analysed"}),
                                loop({5, "off", "off reflux", "healthy", "disabled"})};
  loops[0].rank = 1;
  loops[1].rank = 2;
  for (std::size_t k = 0; k < loops.size(); ++k)
    if (loops[k].code) loops[k].confidence = std::array{0.95, 0.9, 0.7, 0.1, 0.0, 0.8}.at(k);
  loops[1].slot_end_us = 2;
  loops[0].slot_end_us = 1;
  loops[0].area = loops[2].area = "north";
  loops[0].area_place = loops[2].area_place = 1;
  loops[1].area = "South";
  loops[1].area_place = 2;
  loops[1].unit = "crude";
  loops[1].unit_place = 1;
  storage::ListedLoops rows;
  for (const LoopRow& row : loops) rows.push_back(row);
  return rows;
}

const storage::ListedLoops& plant() {
  static const storage::ListedLoops loops = made_plant();
  return loops;
}

LoopListing choose(LoopQuery query, const std::string& part = "") {
  if (query.most == 0) query.most = 100;
  query.part = part;
  return choose_loops(plant(), query, part);
}

std::vector<std::string> names(const LoopQuery& query, const std::string& part = "") {
  std::vector<std::string> found;
  for (const LoopRow& row : choose(query, part).loops) found.emplace_back(row.name);
  return found;
}

TEST(ChooseLoops, FindsByAreaUnitVerdictStateAndWords) {
  EXPECT_THAT(names({.area = "north"}), ElementsAre("FIC1", "LIC3"));
  EXPECT_THAT(names({.unit = "crude"}), ElementsAre("FIC2"));
  EXPECT_THAT(names({.verdict = "healthy"}), ElementsAre("LIC3", "off"));
  EXPECT_THAT(names({.verdict = "none"}), ElementsAre("new"));
  for (const std::string& state : loop_states())
    EXPECT_EQ(names({.state = state}).size(), state == "flagged" ? 2U : 1U) << state;
  EXPECT_THAT(names({}, "ic"), ElementsAre("FIC1", "FIC2", "LIC3", "TIC4"));
  EXPECT_THAT(names({.state = "flagged"}, "reflux"), ElementsAre("FIC1", "FIC2"));
  EXPECT_THAT(names({}, "%"), IsEmpty()) << "words, no pattern";
  EXPECT_THAT(choose_loops(plant(), {.part = "\xff", .most = 9}, "").loops, IsEmpty())
      << "what no text of the database can be";
}

/// What has none of what the order goes by stands behind, whichever way.
TEST(ChooseLoops, InEveryOrderAndBackwards) {
  EXPECT_THAT(names({}), ElementsAre("FIC1", "FIC2", "LIC3", "TIC4", "new", "off"));
  EXPECT_THAT(names({.order = LoopOrder::name, .backwards = true}),
              ElementsAre("TIC4", "off", "new", "LIC3", "FIC2", "FIC1"));
  EXPECT_THAT(names({.order = LoopOrder::area}, "ic"), ElementsAre("FIC1", "LIC3", "FIC2", "TIC4"));
  EXPECT_THAT(names({.order = LoopOrder::area, .backwards = true}, "ic"),
              ElementsAre("FIC2", "FIC1", "LIC3", "TIC4"));
  EXPECT_THAT(names({.order = LoopOrder::confidence}),
              ElementsAre("FIC1", "FIC2", "off", "LIC3", "TIC4", "new"));
  EXPECT_THAT(names({.order = LoopOrder::confidence, .backwards = true}),
              ElementsAre("TIC4", "LIC3", "off", "FIC2", "FIC1", "new"));
  EXPECT_THAT(names({.order = LoopOrder::verdict}),
              ElementsAre("LIC3", "off", "TIC4", "FIC1", "FIC2", "new"));
  EXPECT_EQ(names({.order = LoopOrder::window}).front(), "FIC2");
}

TEST(ChooseLoops, PagesHoldEveryLoopOnce) {
  std::vector<std::string> seen;
  for (const std::int64_t skip : {0, 4}) {
    const LoopListing page = choose({.order = LoopOrder::state, .skip = skip, .most = 4});
    EXPECT_EQ(page.all, 6);
    EXPECT_EQ(page.fitting, 6) << "on all pages";
    for (const LoopRow& row : page.loops) seen.emplace_back(row.name);
  }
  EXPECT_THAT(seen, testing::UnorderedElementsAre("FIC1", "FIC2", "LIC3", "TIC4", "new", "off"));
  EXPECT_EQ(choose({.skip = 400, .most = 4}).loops.size(), 2U) << "the last page";
  EXPECT_EQ(choose({.skip = 400, .most = 4}).skip, 4);
  EXPECT_EQ(choose({.area = "west", .skip = 4, .most = 4}).fitting, 0);
}

TEST(ChooseLoops, OffersWhatLoopsHave) {
  const LoopListing page = choose({.area = "north"});
  EXPECT_THAT(page.areas, ElementsAre("north", "South")) << "in the order of the database";
  EXPECT_THAT(page.units, ElementsAre("crude"));
  EXPECT_THAT(page.verdicts, ElementsAre("healthy", "tight_tuning", "valve_stiction", "none"));
}

}  // namespace
}  // namespace loopscope::daemon
