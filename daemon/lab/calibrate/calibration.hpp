#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/simulate/calibration_families.hpp"
#include "daemon/lab/calibrate/plants.hpp"
#include "daemon/lab/calibrate/record_tests.hpp"

namespace loopscope::daemon {

/// Nominal levels at which rejections are counted.
inline constexpr std::array<double, 2> kLevels = {0.05, 0.01};

/// How one test did on one family.
struct TestTally {
  std::size_t computed = 0;                            ///< records with a p-value
  std::array<std::size_t, kLevels.size()> rejected{};  ///< of them, per level
};

/// A share of trials and what it says of the probability behind it.
struct BinomialShare {
  double share = 0.0;  ///< successes / trials
  double low = 0.0;    ///< Clopper-Pearson limits: they hold the probability in at least 95 % of
  double high = 1.0;   ///< samples, whatever it is
};

/// `successes` of `trials`; throws std::invalid_argument unless 0 < trials and successes <= trials.
[[nodiscard]] BinomialShare binomial_share(std::size_t successes, std::size_t trials);

/// All tests on one family.
struct FamilyTally {
  core::simulate::CalibrationFamily family;
  std::array<TestTally, kRecordTests> tests;
  double estimate_s = 0.0;  ///< CPU seconds of all records: the squared bicoherence alone
  double analyse_s = 0.0;   ///< and the whole analysis
};

/// What was measured, over `records` records of every family.
struct Calibration {
  std::size_t records = 0;
  std::vector<FamilyTally> families;
  std::vector<PlantSummary> plants;  ///< empty when no plant was asked for
};

/// Counts rejections on the first `records` records of every family, in `threads` (>= 1) threads.
/// Counts do not depend on the number of threads. `record_done` is called after every record, never
/// from two threads at once.
[[nodiscard]] std::vector<FamilyTally> tally_families(
    std::span<const core::simulate::CalibrationFamily> families, std::size_t records,
    std::size_t threads, const std::function<void()>& record_done);

}  // namespace loopscope::daemon
