#include "core/hos/residual_noise.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace loopscope::core::hos {
namespace {

/// Quantiles, from either end, between which the rate of the tail is read, and outside of which it
/// is continued. At 0.03 a hundred events in a window of 4096 still lie outside.
constexpr double kTail = 0.20;
constexpr double kFarTail = 0.03;

/// The figures below are for the residuals of a window of 4096; chance widens them as 1 / sqrt(n).
constexpr double kWindow = 4096.0;
/// Asymmetry of the core: 0.015 is one standard deviation of normal values, and a skewness of 0.16
/// shows as 0.05; it raises the mean squared bicoherence by less than its standard deviation.
constexpr double kLargestAsymmetry = 0.05;
/// (q97 - q50) / (q80 - q50), mean of both sides: 2.235 for normal noise with a standard deviation
/// of 0.05, 1.57 for uniform, 2.51 for logistic, 3.07 for Laplacian. The smaller slips of sticking
/// valves reach into the core and widen it to 2.4 to 2.9.
constexpr double kNormalWidth = 2.235;
constexpr double kNarrower = 0.28;
constexpr double kWider = 0.17;
constexpr double kWidest = 2.87;

/// The value that a share `p` of `sorted` (descending) exceeds.
double upper_quantile(const std::vector<double>& sorted, double p) {
  return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size()))];
}

ResidualNoise::Core judge_core(const std::vector<double>& sorted) {
  using Core = ResidualNoise::Core;
  const double median = upper_quantile(sorted, 0.5);
  const double above = upper_quantile(sorted, kFarTail) - median;
  const double below = median - upper_quantile(sorted, 1.0 - kFarTail);
  const double near_above = upper_quantile(sorted, kTail) - median;
  const double near_below = median - upper_quantile(sorted, 1.0 - kTail);
  if (!(near_above > 0.0 && near_below > 0.0)) return Core::other;
  const double width = 0.5 * (above / near_above + below / near_below);
  const double asymmetry = std::abs(above - below) / (above + below);
  const double chance = std::sqrt(kWindow / static_cast<double>(sorted.size()));
  if (asymmetry > chance * kLargestAsymmetry || width < kNormalWidth - chance * kNarrower ||
      width > kWidest) {
    return Core::other;
  }
  return width > kNormalWidth + chance * kWider ? Core::undecided : Core::gaussian;
}

/// Replaces the highest values of `sorted` (descending) by quantiles of the exponential tail.
void continue_tail(std::vector<double>& sorted) {
  const auto outer = static_cast<std::size_t>(kFarTail * static_cast<double>(sorted.size()));
  const double begin = sorted[outer];
  const double scale = (begin - upper_quantile(sorted, kTail)) / std::log(kTail / kFarTail);
  for (std::size_t i = 0; i < outer; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(outer);
    sorted[i] = begin - scale * std::log(share);
  }
}

/// Mirrors the distribution and keeps it descending.
void mirror(std::vector<double>& sorted) {
  std::reverse(sorted.begin(), sorted.end());
  std::transform(sorted.begin(), sorted.end(), sorted.begin(), std::negate<>());
}

}  // namespace

ResidualNoise::ResidualNoise(std::vector<double> residuals) : values_(std::move(residuals)) {
  std::sort(values_.begin(), values_.end(), std::greater<>());
  core_ = judge_core(values_);
  continue_tail(values_);
  mirror(values_);
  continue_tail(values_);
  mirror(values_);
  const double mean =
      std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  for (double& value : values_) value -= mean;
}

double ResidualNoise::draw(std::mt19937_64& random) const {
  // 53 random bits to [0, 1): the same numbers on every platform, unlike the standard library's
  // distributions.
  const double uniform = static_cast<double>(random() >> 11U) * 0x1.0p-53;
  return values_[static_cast<std::size_t>(uniform * static_cast<double>(values_.size()))];
}

}  // namespace loopscope::core::hos
