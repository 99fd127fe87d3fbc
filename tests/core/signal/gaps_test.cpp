#include "core/signal/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/core/signal/arbitrary_samples.hpp"

namespace loopscope::core::signal {
namespace {

struct Run {
  std::size_t first = 0;
  std::size_t end = 0;
};

std::vector<Run> missing_runs(const Samples& samples) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!std::isnan(samples[k])) continue;
    const bool goes_on = !runs.empty() && runs.back().end == k;
    if (goes_on) {
      ++runs.back().end;
    } else {
      runs.push_back({k, k + 1});
    }
  }
  return runs;
}

bool is_inner(const Run& run, const Samples& samples) {
  return run.first > 0 && run.end < samples.size();
}

Samples bridged(Samples samples, std::size_t longest) {
  bridge_gaps(samples, longest);
  return samples;
}

Samples held(Samples samples, std::size_t longest) {
  hold_gaps(samples, longest);
  return samples;
}

std::size_t longest_gap() {
  return *rc::gen::inRange<std::size_t>(0, 40);
}

RC_GTEST_PROP(Gaps, BridgingFillsInnerShortGapsAndNothingElse, ()) {
  const Samples before = *samples_with_gaps();
  const std::size_t longest = longest_gap();
  Samples expected = before;
  const Samples after = bridged(before, longest);
  for (const Run& run : missing_runs(before)) {
    const bool filled = is_inner(run, before) && run.end - run.first <= longest;
    for (std::size_t k = run.first; k < run.end; ++k) {
      RC_ASSERT(std::isnan(after[k]) != filled);
      expected[k] = after[k];
    }
  }
  RC_ASSERT(same(after, expected));
}

RC_GTEST_PROP(Gaps, ABridgeRunsFromOneNeighbourToTheOther, ()) {
  const Samples before = *samples_with_gaps();
  const Samples after = bridged(before, 1000);
  for (const Run& run : missing_runs(before)) {
    if (!is_inner(run, before)) continue;
    const double low = std::min(before[run.first - 1], before[run.end]);
    const double high = std::max(before[run.first - 1], before[run.end]);
    for (std::size_t k = run.first; k < run.end; ++k) {
      RC_ASSERT(after[k] >= low - 1e-9);
      RC_ASSERT(after[k] <= high + 1e-9);
    }
  }
}

RC_GTEST_PROP(Gaps, FillingTwiceIsFillingOnce, ()) {
  const Samples before = *samples_with_gaps();
  const std::size_t longest = longest_gap();
  RC_ASSERT(same(bridged(bridged(before, longest), longest), bridged(before, longest)));
  RC_ASSERT(same(held(held(before, longest), longest), held(before, longest)));
}

RC_GTEST_PROP(Gaps, BridgingKnowsNoDirectionOfTime, ()) {
  const Samples before = *samples_with_gaps();
  const std::size_t longest = longest_gap();
  const Samples there = bridged(before, longest);
  const Samples back = bridged({before.rbegin(), before.rend()}, longest);
  for (std::size_t k = 0; k < there.size(); ++k) {
    const double mirrored = back[back.size() - 1 - k];
    RC_ASSERT(std::isnan(there[k]) == std::isnan(mirrored));
    RC_ASSERT(std::isnan(there[k]) || std::abs(there[k] - mirrored) < 1e-9);
  }
}

RC_GTEST_PROP(Gaps, BridgingGoesAlongWithUnitsOfPowersOfTwo, ()) {
  const Samples before = *samples_with_gaps();
  const double unit = std::ldexp(1.0, *rc::gen::inRange(-40, 41));
  Samples scaled = before;
  for (double& value : scaled) value *= unit;
  Samples expected = bridged(before, 40);
  for (double& value : expected) value *= unit;
  RC_ASSERT(same(bridged(scaled, 40), expected));
}

RC_GTEST_PROP(Gaps, HoldingRepeatsTheSampleBefore, ()) {
  const Samples before = *samples_with_gaps();
  const std::size_t longest = longest_gap();
  const Samples after = held(before, longest);
  for (const Run& run : missing_runs(before)) {
    const bool filled = is_inner(run, before) && run.end - run.first <= longest;
    for (std::size_t k = run.first; k < run.end; ++k)
      RC_ASSERT(same(after[k], filled ? before[run.first - 1] : kMissing));
  }
}

RC_GTEST_PROP(Gaps, OnlyImmenseValuesAreDiscarded, ()) {
  const Samples plain = *samples_with_gaps();
  Samples samples = plain;
  const double immense = *rc::gen::element(1.01 * kLargestValue, -HUGE_VAL, HUGE_VAL, -1e300);
  const auto place = *rc::gen::inRange<std::size_t>(0, plain.size() + 1);
  samples.insert(samples.begin() + static_cast<std::ptrdiff_t>(place), immense);
  Samples expected = plain;
  expected.insert(expected.begin() + static_cast<std::ptrdiff_t>(place), kMissing);
  discard_infinite(samples);
  RC_ASSERT(same(samples, expected));
  RC_ASSERT(count_recorded(samples) == count_recorded(plain));
}

}  // namespace
}  // namespace loopscope::core::signal
