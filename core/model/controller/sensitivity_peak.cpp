#include "core/model/controller/sensitivity_peak.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace loopscope::core::model {
namespace {

/// Frequencies of the sensitivity from kLowestFrequency pi to pi, evenly in their logarithm: 4 %
/// apart, so that a peak of damping 0.02 is met before it is refined to 1e-5 of its frequency.
constexpr int kFrequencies = 180;
constexpr double kLowestFrequency = 1e-3;
constexpr int kRefinements = 20;

double sensitivity(const SampledProcess& process, const ControllerLaw& law, double w) {
  return 1.0 / std::abs(1.0 + response(process, w) * response(law, w));
}

}  // namespace

SensitivityPeak find_sensitivity_peak(const SampledProcess& process, const ControllerLaw& law) {
  const double step = -std::log(kLowestFrequency) / (kFrequencies - 1);
  const auto frequency = [&](double place) {
    return std::numbers::pi * kLowestFrequency * std::exp(step * place);
  };
  const auto at = [&](double place) { return sensitivity(process, law, frequency(place)); };
  int best = 0;
  double peak = 0.0;
  for (int i = 0; i < kFrequencies; ++i) {
    const double s = at(i);
    if (s <= peak) continue;
    peak = s;
    best = i;
  }
  double low = std::max(0, best - 1);
  double high = std::min(kFrequencies - 1, best + 1);
  for (int i = 0; i < kRefinements; ++i) {
    const double third = (high - low) / 3.0;
    if (at(low + third) < at(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  const double middle = 0.5 * (low + high);
  return {std::max({1.0, peak, at(middle)}), frequency(middle)};
}

}  // namespace loopscope::core::model
