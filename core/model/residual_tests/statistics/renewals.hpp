#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// A stretch of equal values.
struct FlatRun {
  std::size_t begin = 0;
  std::size_t samples = 0;
};

/// The runs of a signal, up to a difference of `tolerance`; a missing sample ends a run, and the
/// runs before and after it are not complete. Runs that touch either end of the record or a missing
/// sample are left out.
[[nodiscard]] std::vector<FlatRun> complete_runs(std::span<const double> signal, double tolerance);

struct Clock {
  double p = 1.0;
  std::size_t period_samples = 1;
};

/// The clock that all but a fiftieth of the changes keep to: they begin at one phase of every m
/// samples. Under chance each does with probability 1 / m; m is one of the lengths of the runs or a
/// common divisor of them. p and period are 1 with fewer than five runs, or without such a clock.
[[nodiscard]] Clock find_clock(std::span<const FlatRun> runs);

}  // namespace loopscope::core::model
