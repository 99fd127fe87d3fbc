#include "core/signal/judge_quality.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::core::signal {
namespace {

/// 1000 samples of which `gaps` in the middle were left out by the archive's rule, or taken for so.
PreparedLoop on_change(std::size_t gaps, std::size_t recorded) {
  PreparedLoop loop;
  loop.archive = Archive::on_change;
  for (std::size_t k = 0; k < 1000; ++k) {
    const bool out = k >= 200 && k < 200 + gaps;
    loop.pv.push_back(out ? kMissing : 50.0 + std::sin(0.3 * static_cast<double>(k)));
  }
  loop.error = loop.pv;
  loop.pv_gaps = gaps;
  loop.pv_recorded = recorded;
  loop.pv_stored = 1000 - gaps;
  return loop;
}

TEST(JudgeQuality, WhatWasRecordedIsNeverCalledMissing) {
  const DataQuality all = judge_quality(on_change(700, 1000), {});
  EXPECT_EQ(*all.missing_fraction, 0.0);
  EXPECT_FALSE(all.usable);
  EXPECT_EQ(
      all.reason,
      "70 % of the pv samples stand still or lie on a line and say nothing, at most 40 % may");
  const DataQuality part = judge_quality(on_change(700, 900), {});
  EXPECT_NEAR(*part.missing_fraction, 0.1, 1e-12);
}

TEST(JudgeQuality, GapsThatTheRuleDoesNotExplainAre) {
  const DataQuality quality = judge_quality(on_change(700, 300), {});
  EXPECT_NEAR(*quality.missing_fraction, 0.7, 1e-12);
  EXPECT_EQ(quality.reason, "70 % of the pv samples are missing, at most 40 % may be");
  EXPECT_FALSE(quality.enough);
}

}  // namespace
}  // namespace loopscope::core::signal
