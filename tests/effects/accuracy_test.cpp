#include <gtest/gtest.h>

#include "tests/effects/draws.hpp"
#include "tests/effects/generator.hpp"
#include "tests/effects/summary.hpp"

namespace loopscope::tests::effects {
namespace {

/// Four draws of each kind. The bounds lie about three standard errors of so small a draw from the
/// shares of the long run (README.md), so that a fall of the whole shows and a single
/// draw does not.
TEST(Accuracy, HoldsOnASmallDraw) {
  Plan plan{{}, 70000, 4, 1};
  for (const KindInfo& kind : all_kinds()) plan.kinds.push_back(kind.name);
  const Summary summary = summarise(plan, run_draws(plan));
  EXPECT_GE(summary.accuracy.value_or(0.0), 0.62);
  EXPECT_GE(summary.named_accuracy.value_or(0.0), 0.62);
  EXPECT_LE(summary.false_on_healthy.value_or(1.0), 0.15);
  EXPECT_LE(summary.overconfident_unknown.value_or(1.0), 0.2);
  EXPECT_LE(summary.brier.value_or(1.0), 0.28);
}

}  // namespace
}  // namespace loopscope::tests::effects
