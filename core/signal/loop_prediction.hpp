#pragma once

#include <cstddef>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Predicts a sample of pv, linearly and by least squares, from its own last 8 samples, op's last
/// 15 and those of sp (with the present one).
///
/// Only what came before is used, so that an outlier of the transmitter is in the error whole, and
/// the answer of the loop to its setpoint or its controller is not, however short.
class LoopPrediction {
 public:
  /// `op` and `sp` are as long as pv, or empty where they were not recorded; NaN = missing. Rows
  /// that touch a sample of `suspect` (as long as pv) do not enter the fit. Refers to op and sp.
  LoopPrediction(const Samples& pv, const Samples& op, const Samples& sp,
                 const std::vector<bool>& suspect);

  /// pv(k) less its prediction from this pv, pv units; NaN for k < 15 and where a sample of the row
  /// is missing, and everywhere when fewer than four rows a column were left to fit.
  [[nodiscard]] double error(const Samples& pv, std::size_t k) const;

 private:
  using Row = std::vector<double>;

  [[nodiscard]] Row row(const Samples& pv, std::size_t k) const;
  [[nodiscard]] std::vector<Row> rows_to_fit(const Samples& pv,
                                             const std::vector<bool>& suspect) const;

  const Samples& op_;
  const Samples& sp_;
  bool with_op_ = false;  ///< it moves
  bool with_sp_ = false;
  std::vector<double> weights_;  ///< empty: nothing was fitted
};

}  // namespace loopscope::core::signal
