#include "core/model/limit_cycle/cycle_pace.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/model/limit_cycle/half_cycles.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kCyclesToCompare = 3.0;
constexpr std::size_t kHalvesToCompare = 6;
/// Lengths are read to about a tenth: what varies less tells nothing.
constexpr double kLeastVariance = 0.01;
/// So many half cycles weigh as much as the belief that size and length know nothing of each other.
constexpr double kHalvesOfBelief = 10.0;

/// Logarithms.
struct Halves {
  std::vector<double> lengths, sizes;
};

Halves halves_of(std::span<const double> error) {
  Halves halves;
  const std::vector<double> crossings = crossings_of(error);
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const double length = crossings[i] - crossings[i - 1];
    const auto first = static_cast<std::size_t>(std::ceil(crossings[i - 1]));
    const auto last = static_cast<std::size_t>(crossings[i]);
    double size = 0.0;
    for (std::size_t k = first; k <= last; ++k) size += std::abs(error[k]);
    if (!(size > 0.0)) continue;
    halves.lengths.push_back(std::log(length));
    halves.sizes.push_back(std::log(size / length));
  }
  return halves;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

std::optional<double> pace_by_size(std::span<const double> error, double period_samples) {
  if (static_cast<double>(error.size()) < kCyclesToCompare * period_samples) return std::nullopt;
  const CycleBand band(period_samples);
  const Halves halves = halves_of(band.pass(band.resample(error)));
  const std::size_t count = halves.lengths.size();
  if (count < kHalvesToCompare) return std::nullopt;
  const double length = mean_of(halves.lengths), size = mean_of(halves.sizes);
  double covariance = 0.0, variances = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double longer = halves.lengths[k] - length, larger = halves.sizes[k] - size;
    covariance += longer * larger;
    variances += longer * longer + larger * larger;
  }
  const auto n = static_cast<double>(count);
  return 2.0 * covariance / (variances + n * kLeastVariance) * n / (n + kHalvesOfBelief);
}

}  // namespace loopscope::core::model
