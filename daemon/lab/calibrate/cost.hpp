#pragma once

#include <cstddef>
#include <span>

#include "daemon/lab/calibrate/calibration.hpp"

namespace loopscope::daemon {

/// Mean CPU time of a record.
struct Cost {
  double estimate_us = 0.0;  ///< the squared bicoherence alone
  double analyse_us = 0.0;   ///< the whole analysis
  [[nodiscard]] double ratio() const { return analyse_us / estimate_us; }
};

/// Over the families of `tallies` (not empty) with `records` (> 0) records each.
[[nodiscard]] Cost mean_cost(std::span<const FamilyTally> tallies, std::size_t records);

/// Over the linear Gaussian families, which stand for healthy loops; over all where there is none.
[[nodiscard]] Cost healthy_cost(std::span<const FamilyTally> tallies, std::size_t records);

}  // namespace loopscope::daemon
