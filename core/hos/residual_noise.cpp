#include "core/hos/residual_noise.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "core/hos/uniform_draw.hpp"

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

/// Places, in descending order, of the quantiles that are read.
struct Places {
  std::size_t far_above, above, middle, below, far_below;

  explicit Places(std::size_t count)
      : far_above(static_cast<std::size_t>(kFarTail * static_cast<double>(count))),
        above(static_cast<std::size_t>(kTail * static_cast<double>(count))),
        middle(count / 2),
        below(count - 1 - above),
        far_below(count - 1 - far_above) {}
};

/// Puts each place's value where it would be if all were sorted; a full sort would take as long as
/// two bicoherences, and what lies between the places may have any order.
void place(std::vector<double>& values, const Places& places) {
  std::size_t first = 0;
  for (const std::size_t at :
       {places.far_above, places.above, places.middle, places.below, places.far_below}) {
    std::nth_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                     values.begin() + static_cast<std::ptrdiff_t>(at), values.end(),
                     std::greater<>());
    first = at + 1;
  }
}

ResidualNoise::Core judge_core(const std::vector<double>& values, const Places& places) {
  using Core = ResidualNoise::Core;
  const double median = values[places.middle];
  const double above = values[places.far_above] - median;
  const double below = median - values[places.far_below];
  const double near_above = values[places.above] - median;
  const double near_below = median - values[places.below];
  if (!(near_above > 0.0 && near_below > 0.0)) return Core::other;
  const double width = 0.5 * (above / near_above + below / near_below);
  const double asymmetry = std::abs(above - below) / (above + below);
  const double chance = std::sqrt(kWindow / static_cast<double>(values.size()));
  if (asymmetry > chance * kLargestAsymmetry || width < kNormalWidth - chance * kNarrower ||
      width > kWidest) {
    return Core::other;
  }
  return width > kNormalWidth + chance * kWider ? Core::undecided : Core::gaussian;
}

/// Distance from the start of a tail of its value number `i` of `count`: a quantile of the
/// exponential law of the stretch from `near` to `begin`.
double tail_distance(double begin, double near, std::size_t i, std::size_t count) {
  const double scale = (begin - near) / std::log(kTail / kFarTail);
  return -scale * std::log((static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

/// Replaces what lies beyond the outer places by exponential tails.
void continue_tails(std::vector<double>& values, const Places& places) {
  const double above = values[places.far_above];
  const double below = values[places.far_below];
  for (std::size_t i = 0; i < places.far_above; ++i) {
    values[i] = above + tail_distance(above, values[places.above], i, places.far_above);
    values[values.size() - 1 - i] =
        below + tail_distance(below, values[places.below], i, places.far_above);
  }
}

}  // namespace

ResidualNoise::ResidualNoise(std::vector<double> residuals) : values_(std::move(residuals)) {
  const Places places(values_.size());
  place(values_, places);
  core_ = judge_core(values_, places);
  continue_tails(values_, places);
  const double mean =
      std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  for (double& value : values_) value -= mean;
}

double ResidualNoise::draw(std::mt19937_64& random) const {
  const double place = uniform_draw(random) * static_cast<double>(values_.size());
  return values_[static_cast<std::size_t>(place)];
}

}  // namespace loopscope::core::hos
