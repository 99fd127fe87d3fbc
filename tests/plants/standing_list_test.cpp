#include "tests/plants/standing_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace loopscope::tests::plants {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Watch kWatch{.windows = 6, .onset_windows = 3};

DiagnosedLoop with(double fault_probability) {
  DiagnosedLoop loop{"valve_stiction", fault_probability, std::nullopt, 5, {}};
  loop.fault_probability = fault_probability;
  return loop;
}

PlantLoop loop_named(const std::string& name, const std::string& fault) {
  PlantLoop loop;
  loop.name = name;
  loop.record = "kind";
  loop.fault = fault;
  return loop;
}

/// Of all slots `usual`, but at some.
WatchedLoop watched(double usual, const std::map<std::size_t, double>& but = {}) {
  WatchedLoop loop;
  for (std::size_t slot = 0; slot <= kWatch.windows * kSlotsInWindow; ++slot)
    loop.slots.push_back(with(but.contains(slot) ? but.at(slot) : usual));
  loop.at_limit.resize(loop.slots.size());
  return loop;
}

TEST(FlaggedAfter, WhoeverIsOnTheListLeavesAtALooserShare) {
  const std::vector<DiagnosedLoop> now = {with(0.85), with(0.85), with(0.7)};
  EXPECT_THAT(flagged_after(now, {false, false, false}), ElementsAre(false, false, false));
  EXPECT_THAT(flagged_after(now, {true, false, true}), ElementsAre(true, false, true));
  EXPECT_THAT(flagged_after({with(0.75)}, {true}), ElementsAre(false));
  DiagnosedLoop silent{"insufficient_data", 1.0, {}, 0, {}};
  EXPECT_THAT(flagged_after({silent}, {true}), ElementsAre(true));
  silent.verdict = "not_controlling";
  EXPECT_THAT(flagged_after({silent}, {true}), ElementsAre(false));
}

TEST(StandingList, CountsEntriesFalseOnesAndDelays) {
  const std::vector<PlantLoop> plant = {loop_named("sticks", "valve_stiction"),
                                        loop_named("fine", ""),
                                        loop_named("quiet", "valve_stiction")};
  // The fault begins with slot 31, is listed at 40, leaves at 50 and comes again at 51.
  WatchedLoop sticks = watched(0.1);
  for (std::size_t slot = 40; slot < sticks.slots.size(); ++slot)
    sticks.slots[slot] = with(slot == 50 ? 0.2 : 0.999);
  sticks.single_probability = 0.95;
  const std::vector<WatchedLoop> loops = {sticks, watched(0.1, {{20, 0.999}}), watched(0.3)};
  const StandingList list = run_list(plant, loops, kWatch);
  EXPECT_EQ(list.faults, 2U);
  EXPECT_EQ(list.listed, 1U);
  EXPECT_EQ(list.sure_faults, 1U);
  EXPECT_DOUBLE_EQ(list.entries_per_fault, 2.0);
  EXPECT_DOUBLE_EQ(*list.delay_windows, 1.0);
  EXPECT_NEAR(list.false_entries, 1000.0 / (4.0 + 7.0 + 4.0), 1e-9);
  EXPECT_THAT(list.wrong, ElementsAre(HasSubstr("fine (kind): valve_stiction at slot 20")));
  EXPECT_THAT(list.missed, SizeIs(1));
}

TEST(StandingList, AFaultFromTheStartHasWaitedForAWholeWindow) {
  WatchedLoop tight = watched(0.999);
  tight.single_probability = 0.95;
  tight.from_the_start = true;
  const StandingList list = run_list({loop_named("tight", "tight_tuning")}, {tight}, kWatch);
  EXPECT_DOUBLE_EQ(list.delay_windows.value_or(0.0), 1.0);
}

/// On the list from slot `first` to `last` as saturated, with op at its limit for `share` of the
/// first of these windows.
WatchedLoop saturated(std::size_t first, std::size_t last, double share) {
  WatchedLoop loop = watched(0.1);
  for (std::size_t slot = first; slot <= last; ++slot) {
    loop.slots[slot] = with(0.999);
    loop.slots[slot].verdict = "valve_saturation";
  }
  loop.at_limit[first] = share;
  return loop;
}

StandingList list_of(const WatchedLoop& loop, const std::string& fault = "") {
  return run_list({loop_named("full", fault)}, {loop}, kWatch);
}

TEST(StandingList, ALoadThatTookAllOfOpIsNoFalseEntryWhereItIsSaid) {
  const StandingList list = list_of(saturated(20, 29, 0.1));
  EXPECT_THAT(list.saturated, ElementsAre(HasSubstr("full (kind): valve_saturation at slot 20")));
  EXPECT_THAT(list.saturated, ElementsAre(HasSubstr("op at its limit for 10.0 %")));
  EXPECT_THAT(list.wrong, IsEmpty());
  EXPECT_DOUBLE_EQ(list.false_entries, 0.0);
  EXPECT_NEAR(list.false_entries_with_saturated, 1000.0 / 7.0, 1e-9);
}

TEST(StandingList, ALimitThatOpHardlyTouchesExcusesNothing) {
  EXPECT_THAT(list_of(saturated(20, 29, 0.09)).wrong, ElementsAre(HasSubstr("at slot 20")));
}

TEST(StandingList, AnotherVerdictOnASaturatedLoopIsFalseFromThenOn) {
  WatchedLoop loop = saturated(20, 29, 0.5);
  loop.slots[24].verdict = "valve_stiction";
  const StandingList list = list_of(loop);
  EXPECT_THAT(list.wrong, ElementsAre(HasSubstr("valve_stiction at slot 24")));
  EXPECT_THAT(list.saturated, IsEmpty());
}

TEST(StandingList, ToEnterOpHasToBeAtItsLimitNow) {
  WatchedLoop loop = saturated(20, 29, 0.5);
  std::swap(loop.at_limit[20], loop.at_limit[19]);
  EXPECT_THAT(list_of(loop).wrong, ElementsAre(HasSubstr("at slot 20")));
}

TEST(StandingList, AStayThatOutlastsTheSaturationByAWindowIsFalseFromThenOn) {
  const StandingList list = list_of(saturated(20, 35, 0.5));
  EXPECT_THAT(list.wrong, ElementsAre(HasSubstr("valve_saturation at slot 30")));
  EXPECT_DOUBLE_EQ(list.false_entries, list.false_entries_with_saturated);
}

TEST(StandingList, EveryStayIsCountedForItself) {
  // Excused, off the list, accused, off the list, excused to begin with.
  WatchedLoop loop = saturated(0, 9, 0.5);
  const WatchedLoop later = saturated(40, 52, 0.5);
  for (std::size_t slot = 40; slot <= 52; ++slot) loop.slots[slot] = later.slots[slot];
  loop.at_limit[40] = 0.5;
  loop.slots[20] = with(0.999);
  const StandingList list = list_of(loop);
  EXPECT_THAT(list.saturated, ElementsAre(HasSubstr("at slot 0")));
  EXPECT_THAT(list.wrong, ElementsAre(HasSubstr("at slot 20"), HasSubstr("at slot 50")));
  EXPECT_NEAR(list.false_entries, 2000.0 / 7.0, 1e-9);
  EXPECT_NEAR(list.false_entries_with_saturated, 3000.0 / 7.0, 1e-9);
}

TEST(StandingList, AFaultyLoopIsExcusedLikewiseBeforeItsFault) {
  const StandingList list = list_of(saturated(20, 29, 0.5), "valve_stiction");
  EXPECT_THAT(list.saturated, SizeIs(1));
  EXPECT_THAT(list.wrong, IsEmpty());
  EXPECT_EQ(list.listed, 0U);
}

WatchedLoop sure_fault(const std::map<std::size_t, double>& but) {
  WatchedLoop loop = watched(0.1, but);
  loop.single_probability = 0.95;
  return loop;
}

TEST(StandingList, TheFaultBeginsWithTheFirstWindowThatHoldsASampleOfIt) {
  EXPECT_THAT(list_of(sure_fault({{30, 0.999}}), "valve_stiction").wrong, SizeIs(1));
  const StandingList list = list_of(sure_fault({{31, 0.999}}), "valve_stiction");
  EXPECT_THAT(list.wrong, IsEmpty());
  EXPECT_DOUBLE_EQ(list.delay_windows.value_or(0.0), 0.1);
  EXPECT_EQ(list.listed_as_another, 0U);
  EXPECT_EQ(list_of(sure_fault({{31, 0.999}}), "tight_tuning").listed_as_another, 1U);
}

TEST(StandingList, WhoeverWasOnTheListBeforeItsFaultHasNoDelay) {
  std::map<std::size_t, double> slots;
  for (std::size_t slot = 25; slot <= 35; ++slot) slots[slot] = 0.999;
  slots[55] = 0.999;
  const StandingList list = list_of(sure_fault(slots), "valve_stiction");
  EXPECT_THAT(list.wrong, SizeIs(1));
  EXPECT_EQ(list.listed, 1U);
  EXPECT_DOUBLE_EQ(list.entries_per_fault, 2.0);
  EXPECT_EQ(list.delay_windows, std::nullopt);
  EXPECT_THAT(list.right, ElementsAre(HasSubstr("on the list before its fault, entries 2")));
}

TEST(StandingList, AStayGoesOnAtALooserShare) {
  WatchedLoop loop = sure_fault({{40, 0.999}});
  for (std::size_t slot = 41; slot < loop.slots.size(); ++slot) loop.slots[slot] = with(0.85);
  EXPECT_DOUBLE_EQ(list_of(loop, "valve_stiction").entries_per_fault, 1.0);
}

TEST(StandingList, DelaysAreOfSureFaultsAndInfiniteForThoseThatNeverCame) {
  std::vector<PlantLoop> plant;
  std::vector<WatchedLoop> loops;
  for (const std::size_t slot : {60U, 33U, 45U, 37U}) {  // 3, 0.3, 1.5 and 0.7 windows
    plant.push_back(loop_named("sure", "valve_stiction"));
    loops.push_back(sure_fault({{slot, 0.999}}));
  }
  plant.push_back(loop_named("unsure", "valve_stiction"));
  loops.push_back(sure_fault({{32, 0.999}}));
  loops.back().single_probability = 0.79;
  plant.push_back(loop_named("never", "valve_stiction"));
  loops.push_back(sure_fault({}));
  const StandingList list = run_list(plant, loops, kWatch);
  EXPECT_EQ(list.sure_faults, 5U);
  EXPECT_EQ(list.sure_listed, 4U);
  EXPECT_DOUBLE_EQ(list.delay_windows.value_or(0.0), 1.5);
  EXPECT_EQ(list.delay_windows_p90, std::nullopt);
  plant.pop_back();
  loops.pop_back();
  EXPECT_DOUBLE_EQ(run_list(plant, loops, kWatch).delay_windows_p90.value_or(0.0), 3.0);
}

}  // namespace
}  // namespace loopscope::tests::plants
