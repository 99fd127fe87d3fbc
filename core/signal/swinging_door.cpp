#include "core/signal/swinging_door.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loopscope::core::signal {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Slopes from the sample stored last that pass all samples since.
struct Door {
  double lowest = -kEndless;
  double highest = kEndless;
};

}  // namespace

Samples swinging_door(const Samples& samples, double band) {
  Samples stored(samples.size(), kMissing);
  std::size_t last = 0;
  Door door;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool ends = k + 1 == samples.size() || std::isnan(samples[k + 1]);
    const bool starts = k == 0 || std::isnan(samples[k - 1]);
    if (std::isnan(samples[k])) continue;
    if (starts || ends) stored[k] = samples[k];
    if (starts) {
      last = k;
      door = {};
      continue;
    }
    const auto slope = [&](double offset) {
      return (samples[k] + offset - samples[last]) / static_cast<double>(k - last);
    };
    if (slope(0.0) < door.lowest || slope(0.0) > door.highest) {
      last = k - 1;
      stored[last] = samples[last];
      door = {};
    }
    door = {std::max(door.lowest, slope(-band)), std::min(door.highest, slope(band))};
  }
  return stored;
}

}  // namespace loopscope::core::signal
