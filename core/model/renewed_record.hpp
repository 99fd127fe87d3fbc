#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// A held record thinned to one row for each renewal of pv. NaN = missing, as in the record.
struct RenewedRecord {
  std::size_t samples_per_row = 1;
  std::vector<double> pv;     ///< as renewed
  std::vector<double> op;     ///< mean over the samples up to the renewal: what pv answers to
  std::vector<double> sp;     ///< at the renewal; empty = not recorded
  std::vector<double> error;  ///< at the renewal; empty = not recorded
};

/// Takes every `hold_samples`-th sample, at the phase at which pv changes most often. Each of `op`,
/// `sp` and `error` is empty or as long as `pv`; hold_samples >= 1.
[[nodiscard]] RenewedRecord renewed_record(std::span<const double> pv, std::span<const double> op,
                                           std::span<const double> sp,
                                           std::span<const double> error, std::size_t hold_samples);

}  // namespace loopscope::core::model
