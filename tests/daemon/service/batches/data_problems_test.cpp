#include "daemon/service/batches/data_problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kNow = 1'767'225'600 * kSecond_us;

storage::CatalogueEntry loop_of_10_s() {
  storage::CatalogueEntry loop;
  loop.period_s = 600.0;
  loop.interval_s = 10.0;
  return loop;
}

LoopWindowAtSlot with(const TagReading& reading) {
  LoopWindowAtSlot at_slot;
  at_slot.slot_end_us = kNow;
  at_slot.tags = {reading};
  return at_slot;
}

/// "code role" of each problem of a tag whose newest row is so many seconds old.
std::vector<std::string> problems_at_age(std::string_view role, std::int64_t age_s) {
  std::vector<std::string> found;
  for (const auto& problem : tag_problems(
           loop_of_10_s(), with({role, kNow - age_s * kSecond_us, kNow, 0, 100, 0, 0, 0}), 4096)) {
    found.push_back(problem.code + " " + problem.role);
  }
  return found;
}

TEST(DataProblems, ATagWithoutAnyRow) {
  const auto problems =
      tag_problems(loop_of_10_s(), with({"op", std::nullopt, kNow, 0, 0, 0, 0, 0}), 4096);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, "no_rows");
  EXPECT_EQ(problems[0].role, "op");
  EXPECT_FALSE(problems[0].last_row_us);
}

TEST(DataProblems, PvIsDeadAfter512SamplesOpAfterAWindow) {
  EXPECT_THAT(problems_at_age("pv", 5120), IsEmpty());
  EXPECT_THAT(problems_at_age("pv", 5121), ElementsAre("dead_tag pv"));
  EXPECT_THAT(problems_at_age("op", 40'960), IsEmpty());
  EXPECT_THAT(problems_at_age("op", 40'961), ElementsAre("dead_tag op"));
  EXPECT_THAT(problems_at_age("mv", 40'961), ElementsAre("dead_tag mv"));
  EXPECT_THAT(problems_at_age("sp", 10'000'000), IsEmpty()) << "recorded on change";
  EXPECT_THAT(problems_at_age("mode", 10'000'000), IsEmpty());
}

TEST(DataProblems, ALongPeriodIsWaitedFor) {
  storage::CatalogueEntry loop = loop_of_10_s();
  loop.period_s = 86'400.0;
  EXPECT_THAT(
      tag_problems(loop, with({"pv", kNow - 170'000 * kSecond_us, kNow, 0, 1, 0, 0, 0}), 4096),
      IsEmpty());
  EXPECT_EQ(tag_problems(loop, with({"pv", kNow - 180'000 * kSecond_us, kNow, 0, 1, 0, 0, 0}), 4096)
                .size(),
            1u);
}

TEST(DataProblems, MostlyBadRowsAndRowsInTheFuture) {
  const auto problems =
      tag_problems(loop_of_10_s(), with({"pv", kNow, kNow, 3, 100, 51, 0, 0}), 4096);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].code, "bad_quality");
  EXPECT_DOUBLE_EQ(problems[0].figure.value(), 0.51);
  EXPECT_EQ(problems[1].code, "future_rows");
  EXPECT_DOUBLE_EQ(problems[1].figure.value(), 3.0);
  EXPECT_THAT(tag_problems(loop_of_10_s(), with({"pv", kNow, kNow, 0, 100, 50, 0, 0}), 4096),
              IsEmpty());
}

TEST(DataProblems, QualityCodesThatNobodyKnowsAreCounted) {
  const auto problems =
      tag_problems(loop_of_10_s(), with({"op", kNow, kNow, 0, 100, 7, 0, 7}), 4096);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, "unknown_quality");
  EXPECT_EQ(problems[0].role, "op");
  EXPECT_DOUBLE_EQ(problems[0].figure.value(), 7.0);
}

TEST(DataProblems, FlagsAsTheyAreWhateverTheirName) {
  core::Diagnosis diagnosis;
  diagnosis.evidence.data_quality.flags = {"op_constant", "a_flag_of_tomorrow"};
  diagnosis.verdict.code = core::diagnosis::VerdictCode::insufficient_data;
  const auto problems = flag_problems(diagnosis);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[1].code, "a_flag_of_tomorrow");
  EXPECT_EQ(problems[1].role, "");
  EXPECT_EQ(problems[2].code, "insufficient_data");
}

}  // namespace
}  // namespace loopscope::daemon
