#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/plant/event_box.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "daemon/report/sections/loop_list.hpp"
#include "daemon/report/sections/loop_section.hpp"
#include "daemon/report/sections/why_not_listed.hpp"
#include "tests/daemon/report/event_rows.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/daemon/times.hpp"

/// Every time of the pages in the zone of the plant. What they say in UTC stands in the tests of
/// the sections.
namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A plant in which everything was at `time_us`, and new since a minute before.
std::string plant_words(std::int64_t time_us, const std::string& zone) {
  PlantFacts facts = plant_facts("FIC101");
  facts.zone = TimeZone(zone);
  facts.since_us = time_us - kMinute_us;
  facts.oscillations.front().slot_end_us = time_us;
  facts.repairs.front().done_at_us = time_us;
  facts.counts.without_controller.front().since_us = time_us;
  facts.counts.reasons.front().remedy = "Wait until 2026-03-01 12:00 UTC";
  for (storage::FlaggedRow& row : facts.flagged) row.since_us = row.slot_end_us = time_us;
  return words_of(plant_section(facts, LoopLinks::sections({1, 2})).html);
}

std::string loop_words(std::int64_t time_us, const std::string& zone) {
  LoopReport told;
  told.zone = TimeZone(zone);
  told.row = flagged_row(7, "FIC101");
  told.row.since_us = time_us - kMinute_us;
  told.row.slot_end_us = time_us;
  told.repairs = plant_facts("FIC101").repairs;
  told.repairs.front().done_at_us = time_us;
  told.repairs.front().statement = "It is back in the newest window, of 2026-03-01 12:00 UTC.";
  told.problems = {{"not_controlling", "pv", "", "Out of service, since 2026-03-01 12:00 UTC",
                    "Wait until 2026-03-01 12:00 UTC", time_us, true}};
  return words_of(loop_section(told).html);
}

TEST(LocalTimes, ThePlantInKolkata) {
  EXPECT_THAT(
      plant_words(kNoon_us, "Asia/Kolkata"),
      AllOf(HasSubstr("new since 2026-03-01 17:29 IST\n"), HasSubstr("| Since (Asia/Kolkata) |"),
            HasSubstr("| confirmed | 2026-03-01 17:30 IST new |"),
            HasSubstr("FIC101 | 2026-03-01 17:30 IST | valve: FIC101"),
            HasSubstr("manual, tracking or out of service | 2026-03-01 17:30 IST | 25 %"),
            HasSubstr("Wait until 2026-03-01 17:30 IST\n"), Not(HasSubstr("UTC"))));
}

// The two moments, a minute apart, are told an hour apart, or back, each by its own clock.
TEST(LocalTimes, ThePlantInBerlinOverBothChangesOfTheClock) {
  EXPECT_THAT(plant_words(kBerlinForward_us, "Europe/Berlin"),
              AllOf(HasSubstr("new since 2026-03-29 01:59 CET\n"),
                    HasSubstr("| confirmed | 2026-03-29 03:00 CEST new |"),
                    HasSubstr("FIC101 | 2026-03-29 03:00 CEST | valve: FIC101"),
                    HasSubstr("out of service | 2026-03-29 03:00 CEST | 25 %")));
  EXPECT_THAT(plant_words(kBerlinBack_us, "Europe/Berlin"),
              AllOf(HasSubstr("new since 2026-10-25 02:59 CEST\n"),
                    HasSubstr("| confirmed | 2026-10-25 02:00 CET new |"),
                    HasSubstr("FIC101 | 2026-10-25 02:00 CET | valve: FIC101"),
                    HasSubstr("out of service | 2026-10-25 02:00 CET | 25 %")));
}

TEST(LocalTimes, ALoopInKolkata) {
  EXPECT_THAT(
      loop_words(kNoon_us, "Asia/Kolkata"),
      AllOf(HasSubstr("since 2026-03-01 17:29 IST window until 2026-03-01 17:30 IST\n"),
            HasSubstr("It is back in the newest window, of 2026-03-01 17:30 IST."),
            HasSubstr("Out of service, since 2026-03-01 17:30 IST | pv | 2026-03-01 17:30 IST "
                      "| Wait until 2026-03-01 17:30 IST\n"),
            Not(HasSubstr("UTC"))));
}

TEST(LocalTimes, ALoopInBerlinOverBothChangesOfTheClock) {
  EXPECT_THAT(loop_words(kBerlinForward_us, "Europe/Berlin"),
              HasSubstr("since 2026-03-29 01:59 CET window until 2026-03-29 03:00 CEST\n"));
  EXPECT_THAT(loop_words(kBerlinBack_us, "Europe/Berlin"),
              HasSubstr("since 2026-10-25 02:59 CEST window until 2026-10-25 02:00 CET\n"));
}

TEST(LocalTimes, ListsAndBoxes) {
  const TimeZone berlin("Europe/Berlin");
  storage::LoopRow row;
  row.name = "TIC2";
  row.slot_end_us = kBerlinBack_us;
  EXPECT_THAT(words_of(loop_list({.loops = {row}, .fitting = 1, .all = 1}, {}, berlin).html),
              HasSubstr("| 2026-10-25 02:00 CET\n"));
  storage::PlantOscillationRow event = sample_event(3);
  event.slot_end_us = kBerlinBack_us;
  EXPECT_THAT(words_of(event_box(event, {}, LoopLinks::pages(), berlin).html),
              HasSubstr("2026-10-25 02:00 CET"));
  const storage::HiddenRow hidden{"suppressed",      "shut down", "eve", kBerlinForward_us - 1,
                                  kBerlinForward_us, {},          {}};
  EXPECT_THAT(why_not_listed({hidden}, berlin).html,
              HasSubstr("2026-03-29 01:59 CET, until 2026-03-29 03:00 CEST: "));
}

TEST(LocalTimes, ThePageNamesItsZoneForScreenAndPaper) {
  const std::string local = page({.title = "Plant", .subtitle = {}, .zone = "Europe/Berlin"}, {});
  EXPECT_THAT(local, AllOf(HasSubstr("All times are local, Europe/Berlin."),
                           HasSubstr("<header class=\"top\" data-zone=\"Europe/Berlin\">")));
  EXPECT_THAT(page({.title = "Plant", .subtitle = {}}, {}),
              AllOf(HasSubstr("All times are UTC."), HasSubstr("data-zone=\"UTC\"")));
}

}  // namespace
}  // namespace loopscope::daemon
