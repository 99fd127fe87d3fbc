#include "daemon/service/observe/stage_timings.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

storage::StageCost batch(std::size_t loops) {
  return {.loops = loops,
          .analysed = loops,
          .modelled = loops / 2,
          .values = 1000 * loops,
          .fetch_s = 0.004 * static_cast<double>(loops),
          .model_s = 0.020 * static_cast<double>(loops / 2)};
}

TEST(StageTimings, GivesOutWhatWasNotTakenYet) {
  StageTimings book;
  book.add(batch(16));
  book.add(batch(8));
  EXPECT_FALSE(book.take(false)) << "a minute has not passed";
  const auto taken = book.take(true);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->loops, 24U);
  EXPECT_NEAR(taken->fetch_s, 0.096, 1e-12);
  EXPECT_FALSE(book.take(true)) << "nothing is left";
  book.add(batch(2));
  EXPECT_EQ(book.take(true)->loops, 2U);
  EXPECT_EQ(book.sum().loops, 26U);
}

TEST(StageTimings, ClaimsThatFoundNothingAreNotWorthARow) {
  StageTimings book;
  book.add({.claim_s = 0.001});
  EXPECT_FALSE(book.take(true));
}

TEST(StageCost, DifferenceUndoesAddition) {
  storage::StageCost sum = batch(16);
  storage::add(sum, batch(8));
  const storage::StageCost rest = storage::difference(sum, batch(16));
  EXPECT_EQ(rest.loops, 8U);
  EXPECT_EQ(rest.modelled, 4U);
  EXPECT_EQ(rest.values, 8000U);
  EXPECT_NEAR(rest.model_s, 0.08, 1e-12);
}

TEST(CostText, IsPerLoopAndPerModel) {
  EXPECT_EQ(cost_text(batch(10)),
            "ms a loop: claim 0.00, fetch 4.00, prepare 0.00, statistics 0.00, model 10.00 (20.0 "
            "each of 5), decide 0.00, write 0.00, waiting for a core 0.00");
  EXPECT_EQ(cost_text(batch(1)),
            "ms a loop: claim 0.00, fetch 4.00, prepare 0.00, statistics 0.00, model 0.00, decide "
            "0.00, write 0.00, waiting for a core 0.00");
  EXPECT_EQ(cost_text({}), "");
}

}  // namespace
}  // namespace loopscope::daemon
