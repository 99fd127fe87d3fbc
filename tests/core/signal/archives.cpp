#include "tests/core/signal/archives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/signal/order/spread.hpp"
#include "core/signal/swinging_door.hpp"

namespace loopscope::core::signal {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Slopes from the sample kept last.
struct Door {
  double lowest = -kEndless;
  double highest = kEndless;
};

}  // namespace

Kept keep_dead_band(const Samples& samples, double band) {
  Kept kept{0};
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (std::abs(samples[k] - samples[kept.back()]) > band) kept.push_back(k);
  }
  return kept;
}

Kept keep_swinging_door(const Samples& samples, double band) {
  const Samples stored = swinging_door(samples, band);
  Kept kept;
  for (std::size_t k = 0; k < stored.size(); ++k) {
    if (std::isfinite(stored[k])) kept.push_back(k);
  }
  return kept;
}

Kept keep_opening_doors(const Samples& samples, double band) {
  Kept kept{0};
  Door door{kEndless, -kEndless};  // the upper door's highest slope is `highest`
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const auto slope = [&](double hinge) {
      return (samples[k] - samples[kept.back()] - hinge) / static_cast<double>(k - kept.back());
    };
    const Door next{std::min(door.lowest, slope(-band)), std::max(door.highest, slope(band))};
    if (next.highest > next.lowest) {
      kept.push_back(k - 1);
      door = {slope(-band), slope(band)};
    } else {
      door = next;
    }
  }
  kept.push_back(samples.size() - 1);
  return kept;
}

Kept keep_one_in(double factor, const Samples& samples,
                 const std::function<Kept(const Samples&, double)>& keep) {
  double low = 0.0;
  double high = 4.0 * measure_spread(samples)->std;
  Kept kept;
  for (int i = 0; i < 20; ++i) {
    const double band = 0.5 * (low + high);
    kept = keep(samples, band);
    const bool enough =
        static_cast<double>(kept.size()) * factor < static_cast<double>(samples.size());
    (enough ? high : low) = band;
  }
  return kept;
}

Samples only(const Samples& samples, const Kept& kept) {
  Samples result(samples.size(), kMissing);
  for (const std::size_t k : kept) result[k] = samples[k];
  return result;
}

Samples held_between(const Samples& samples, const Kept& kept) {
  Samples result(samples.size(), samples[kept.front()]);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    std::fill(result.begin() + static_cast<std::ptrdiff_t>(kept[i]), result.end(),
              samples[kept[i]]);
  }
  return result;
}

Samples lines_between(const Samples& samples, const Kept& kept) {
  Samples result = held_between(samples, kept);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const double from = samples[kept[i - 1]];
    const auto span = static_cast<double>(kept[i] - kept[i - 1]);
    for (std::size_t k = kept[i - 1]; k < kept[i]; ++k) {
      const double share = static_cast<double>(k - kept[i - 1]) / span;
      result[k] = from + share * (samples[kept[i]] - from);
    }
  }
  return result;
}

}  // namespace loopscope::core::signal
