#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/record/row_grid.hpp"

namespace loopscope::core::model {

/// A held record thinned to one row for each renewal of pv, for what asks of one value of each
/// signal a row. NaN = missing, as in the record.
struct RenewedRecord {
  RowGrid grid;               ///< the renewals
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
