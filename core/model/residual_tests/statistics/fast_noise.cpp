#include "core/model/residual_tests/statistics/fast_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/model/residual_tests/statistics/centred.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kKept = 0.98;

/// Root mean square of the smaller values.
double trimmed_rms(std::span<const double> values) {
  std::vector<double> squares;
  for (const double value : values)
    if (std::isfinite(value)) squares.push_back(value * value);
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(squares.size()));
  if (kept == 0) return 0.0;
  std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(kept),
                   squares.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < kept; ++k) sum += squares[k];
  return std::sqrt(sum / static_cast<double>(kept));
}

}  // namespace

double fast_noise_std(const ResidualView& view) {
  return std::max(trimmed_rms(increments(view.pv)) / std::numbers::sqrt2,
                  trimmed_rms(view.innovation));
}

}  // namespace loopscope::core::model
