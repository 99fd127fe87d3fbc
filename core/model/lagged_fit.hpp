#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// Lags of pv: enough to stand for measurement noise and a wandering load as well as the process.
inline constexpr std::size_t kOutputLags = 6;
/// Lags of mv, 1 to this: delay and process together.
inline constexpr std::size_t kInputLags = 12;
inline constexpr std::size_t kLaggedColumns = kOutputLags + 1 + kInputLags;

/// pv as means over `samples_per_row` samples, less its mean, and the rows that count.
struct LaggedRows {
  struct Run {
    std::size_t begin, end;
  };
  std::size_t samples_per_row = 1;
  std::vector<double> output;         ///< one value a row
  std::vector<Run> runs;              ///< rows to fit, each with usable lags
  std::vector<std::uint8_t> counted;  ///< by row: lies in a run
  std::size_t rows = 0;               ///< in the runs
  /// Sums over the runs of output(k-i) output(k-j), and of output(k-i).
  std::array<std::array<double, kOutputLags + 1>, kOutputLags + 1> products{};
  std::array<double, kOutputLags + 1> sums{};
};

/// pv(k) = sum a_i pv(k-i) + c + sum b_j mv(k-j): a_1.., c, b_1...
struct LaggedModel {
  std::array<double, kLaggedColumns> weights{};
  double residual = 0.0;  ///< sum of squares over the rows
};

/// Least squares by the normal equations. Delay, poles and noise are all in the weights, so no
/// search stands inside. A column that adds nothing to those before it (the PI law makes op of pv)
/// gets weight 0. `input`: one value a row.
[[nodiscard]] LaggedModel fit_lagged(const LaggedRows& rows, std::span<const double> input);

}  // namespace loopscope::core::model
