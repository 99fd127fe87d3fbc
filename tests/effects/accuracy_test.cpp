#include <algorithm>
#include <gtest/gtest.h>

#include "tests/effects/draws.hpp"
#include "tests/effects/generator.hpp"
#include "tests/effects/summary.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr std::size_t kDraws = 4;

template <typename Chosen>
std::size_t kinds_that(const Chosen& chosen) {
  const auto& kinds = all_kinds();
  return static_cast<std::size_t>(std::count_if(kinds.begin(), kinds.end(), chosen));
}

/// Four draws of each kind; one in the short form. The bounds lie about three standard errors of so
/// small a draw from the shares of the long run (README.md), so that a fall of the whole shows and
/// a single draw does not.
TEST(Accuracy, HoldsOnASmallDraw) {
  const std::size_t kinds = all_kinds().size();
  const std::size_t draws = (records(kDraws * kinds) + kinds - 1) / kinds;
  Plan plan{{}, 70000, draws, 1};
  for (const KindInfo& kind : all_kinds()) plan.kinds.push_back(kind.name);
  const auto slack = [&](double bound, std::size_t of_kinds) {
    return three_errors_farther(bound, kDraws * of_kinds, draws * of_kinds);
  };
  const std::size_t known = kinds_that([](const auto& k) { return k.group != Group::unknown; });
  const std::size_t healthy = kinds_that([](const auto& k) { return k.group == Group::healthy; });
  const std::size_t with_effects = known - healthy;
  const std::size_t unknown = kinds - known;
  const Summary summary = summarise(plan, run_draws(plan));
  EXPECT_GE(summary.accuracy.value_or(0.0), 0.62 - slack(0.62, known));
  EXPECT_GE(summary.named_accuracy.value_or(0.0), 0.62 - slack(0.62, with_effects));
  EXPECT_LE(summary.false_on_healthy.value_or(1.0), 0.15 + slack(0.15, healthy));
  EXPECT_LE(summary.overconfident_unknown.value_or(1.0), 0.2 + slack(0.2, unknown));
  EXPECT_LE(summary.brier.value_or(1.0), 0.28 + slack(0.28, kinds));
}

}  // namespace
}  // namespace loopscope::tests::effects
