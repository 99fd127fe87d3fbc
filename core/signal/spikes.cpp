#include "core/signal/spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/signal/median.hpp"

namespace loopscope::core::signal {
namespace {

constexpr std::size_t kReach = 2;
constexpr double kFarOff = 10.0;
constexpr double kMostSpikes = 0.01;

/// Distance of sample k from the median of its five neighbours (itself included); 0 at the ends and
/// beside gaps, where there is too little to compare with.
double distance_at(const Samples& samples, std::size_t k) {
  if (k < kReach || k + kReach >= samples.size()) return 0.0;
  std::array<double, 2 * kReach + 1> near{};
  std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(k - kReach), near.size(), near.begin());
  if (std::any_of(near.begin(), near.end(), [](double v) { return std::isnan(v); })) return 0.0;
  std::nth_element(near.begin(), near.begin() + kReach, near.end());
  return std::abs(samples[k] - near[kReach]);
}

double usual_distance(std::vector<double> distances) {
  // The sample in the middle is the median itself in a fifth of the cases or more: zeros would pull
  // the scale down and are left out.
  std::erase(distances, 0.0);
  return distances.empty() ? 0.0 : kMadToSigma * median(std::move(distances));
}

}  // namespace

std::size_t discard_spikes(Samples& samples) {
  std::vector<double> distances(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) distances[k] = distance_at(samples, k);
  const double limit = kFarOff * usual_distance(distances);
  if (!(limit > 0.0)) return 0;
  const auto far_off = [limit](double distance) { return distance > limit; };
  const auto spikes =
      static_cast<std::size_t>(std::count_if(distances.begin(), distances.end(), far_off));
  if (static_cast<double>(spikes) > kMostSpikes * static_cast<double>(samples.size())) return 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (far_off(distances[k])) samples[k] = kMissing;
  }
  return spikes;
}

}  // namespace loopscope::core::signal
