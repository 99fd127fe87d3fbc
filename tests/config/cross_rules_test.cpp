#include "config/cross_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> lines_with(const std::string& members) {
  return lines_of(minimal_with(members));
}

std::string with_historians(const std::string& array) {
  return R"({"results": {"connection": "a"}, "historians": )" + array + "}";
}

TEST(CrossRules, AtLeastOneHistorian) {
  const auto expected = ElementsAre("/historians: is missing or empty, at least one is needed");
  EXPECT_THAT(lines_of(with_historians("[]")), expected);
  EXPECT_THAT(lines_of(R"({"results": {"connection": "a"}})"), expected);
}

TEST(CrossRules, HistorianNamesAreUnique) {
  EXPECT_THAT(lines_of(with_historians(R"([{"connection": "a"}, {"connection": "b"},
                                           {"name": "plant", "connection": "c"}])")),
              ElementsAre("/historians/1/name: is the name of /historians/0/name too",
                          "/historians/2/name: is the name of /historians/0/name too"));
}

TEST(CrossRules, QualityRuleNeedsAColumn) {
  EXPECT_THAT(lines_of(with_historians(R"([{"connection": "a", "quality_column": ""}])")),
              ElementsAre("/historians/0/quality_rule: \"opcda\" needs a quality column"));
  EXPECT_THAT(lines_of(with_historians(
                  R"([{"connection": "a", "quality_column": "", "quality_rule": "none"}])")),
              IsEmpty());
}

TEST(CrossRules, LeaseOutlivesThreeLooks) {
  EXPECT_THAT(lines_with(R"("schedule": {"poll_s": 5, "lease_s": 14.9})"),
              ElementsAre("/schedule/lease_s: 14.9 s is less than 3 poll_s, 15 s"));
  EXPECT_THAT(lines_with(R"("schedule": {"poll_s": 5, "lease_s": 15})"), IsEmpty());
}

TEST(CrossRules, PeriodIsNotShorterThanALook) {
  EXPECT_THAT(lines_with(R"("schedule": {"default_period_s": 5})"),
              ElementsAre("/schedule/default_period_s: 5 s is less than poll_s, 10 s"));
}

TEST(CrossRules, HintsSayWhy) {
  struct Case {
    const char* members;
    const char* hint;
  };
  for (const Case& one :
       {Case{R"("schedule": {"poll_s": 5, "lease_s": 14.9})",
             "hold loops longer or poll more often"},
        Case{R"("schedule": {"default_period_s": 5})",
             "no loop is analysed more often than the daemon polls"},
        Case{R"("flags": {"list_leave_probability": 0.81})",
             "loops would enter the list and leave it at once"},
        Case{R"("report": {"folder": "reports"})",
             "write it from the root on, \"/var/lib/loopscope/reports\"; \"\" = none"},
        Case{R"("analysis": {"window_samples": 1000, "min_usable_samples": 1001})",
             "no window could be judged"}})
    EXPECT_EQ(first_hint_of(minimal_with(one.members)), one.hint) << one.members;
  EXPECT_THAT(lines_with(R"("report": {"pages_origin": "javascript:x"
})"),
              ElementsAre("/report/pages_origin: is no address as browsers show it"));
  EXPECT_THAT(lines_with(R"("report": {"folder": "reports"})"),
              ElementsAre("/report/folder: is not an absolute path"));
}

TEST(CrossRules, TheTimeZoneIsOneThatTheSystemKnows) {
  for (const char* zone : {"UTC", "Europe/Berlin", "Asia/Kolkata", "Etc/GMT+3"})
    EXPECT_THAT(lines_with(R"("plant": {"time_zone": ")" + std::string(zone) + "\"}"), IsEmpty());
  const std::string misspelt = R"("plant": {"time_zone": "Europe/Berln"})";
  EXPECT_THAT(lines_with(misspelt),
              ElementsAre("/plant/time_zone: is not the name of a time zone"));
  EXPECT_EQ(first_hint_of(minimal_with(misspelt)), "did you mean \"Europe/Berlin\"?");
}

TEST(CrossRules, NoLoopEntersTheListAndLeavesItAtOnce) {
  EXPECT_THAT(lines_with(R"("flags": {"list_false_share": 0.1, "list_leave_share": 0.05})"),
              ElementsAre("/flags/list_leave_share: 0.05 is less than list_false_share, 0.1"));
  EXPECT_THAT(lines_with(R"("flags": {"list_leave_probability": 0.81})"),
              ElementsAre("/flags/list_leave_probability: 0.81 is more than "
                          "list_least_probability, 0.8"));
  EXPECT_THAT(lines_with(R"("flags": {"list_leave_probability": 0.8})"), IsEmpty());
}

TEST(CrossRules, UsableSamplesFitIntoTheWindow) {
  EXPECT_THAT(lines_with(R"("analysis": {"window_samples": 1000, "min_usable_samples": 1001})"),
              ElementsAre("/analysis/min_usable_samples: 1001 samples are more than "
                          "window_samples, 1000 samples"));
}

TEST(CrossRules, DftTakesAWholeSegment) {
  EXPECT_THAT(lines_with(R"("analysis": {"hos": {"segment_length": 256}})"),
              ElementsAre("/analysis/hos/dft_length: 128 samples are less than segment_length, "
                          "256 samples"));
}

TEST(CrossRules, OverlapIsAWholeNumberOfSamples) {
  const std::string text = minimal_with(R"("analysis": {"hos": {"overlap": 0.3}})");
  EXPECT_THAT(lines_of(text), ElementsAre("/analysis/hos/overlap: 0.3 of a segment is 19.2 "
                                          "samples, not a whole number"));
  EXPECT_EQ(first_hint_of(text), "0.296875 is 19 samples");
  // 0.7 * 70 is not 49 in binary
  EXPECT_THAT(lines_with(R"("analysis": {"hos": {"overlap": 0.7, "segment_length": 70}})"),
              IsEmpty());
}

TEST(CrossRules, ShortestWindowHoldsTwoSegments) {
  const std::string hos = R"("hos": {"segment_length": 1024, "dft_length": 1024, "overlap": 0.5})";
  EXPECT_THAT(lines_with(R"("analysis": {"min_usable_samples": 1536, )" + hos + "}"), IsEmpty());
  EXPECT_THAT(lines_with(R"("analysis": {"min_usable_samples": 1535, )" + hos + "}"),
              ElementsAre("/analysis/hos/segment_length: two segments take 1536 samples, more than "
                          "min_usable_samples, 1535 samples"));
}

TEST(CrossRules, WindowHoldsTheCyclesOfTheShortestOscillation) {
  EXPECT_THAT(
      lines_with(R"("analysis": {"oscillation": {"min_cycles": 600}})"),
      ElementsAre("/analysis/oscillation/min_cycles: 600 cycles of the shortest period take 4800 "
                  "samples, more than window_samples, 4096 samples"));
}

TEST(CrossRules, DelaysAreInOrder) {
  EXPECT_THAT(lines_with(R"("analysis": {"performance": {"min_delay_samples": 11}})"),
              ElementsAre("/analysis/performance/min_delay_samples: 11 samples are more than "
                          "max_delay_samples, 10 samples"));
}

TEST(CrossRules, RefusedValuesAreNotJudgedByTheirDefaults) {
  // Without poll_s, 3 times its default would be more than the lease.
  EXPECT_THAT(lines_with(R"("schedule": {"poll_s": "1", "lease_s": 20})"),
              ElementsAre(HasSubstr("/schedule/poll_s: is a text")));
}

}  // namespace
}  // namespace loopscope::config::tests
