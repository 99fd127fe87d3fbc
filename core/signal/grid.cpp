#include "core/signal/grid.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::signal {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

/// Slot whose time is nearest to `time_us`; may lie outside the grid.
double nearest_slot(const Grid& grid, std::int64_t time_us) {
  const auto offset_us = static_cast<double>(time_us - grid.start_us);
  return std::floor(offset_us / (grid.sample_interval_s * kMicrosecondsPerSecond) + 0.5);
}

void place_samples(const RawSeries& rows, const Grid& grid, Samples& slots) {
  for (std::size_t row = 0; row < rows.time_us.size(); ++row) {
    const double slot = nearest_slot(grid, rows.time_us[row]);
    if (slot >= 0.0 && slot < static_cast<double>(grid.size)) {
      slots[static_cast<std::size_t>(slot)] = rows.value[row];
    }
  }
}

void place_steps(const RawSeries& rows, const Grid& grid, Samples& slots) {
  // A change recorded within half an interval after a slot belongs to that slot, as it does for
  // periodic samples: the scan that saw it is the slot's.
  std::size_t row = 0;
  double held = kMissing;
  for (std::size_t k = 0; k < grid.size; ++k) {
    while (row < rows.time_us.size() &&
           nearest_slot(grid, rows.time_us[row]) <= static_cast<double>(k)) {
      held = rows.value[row];
      ++row;
    }
    slots[k] = held;
  }
}

}  // namespace

std::int64_t Grid::time_us(std::size_t k) const {
  return start_us +
         std::llround(static_cast<double>(k) * sample_interval_s * kMicrosecondsPerSecond);
}

Samples align(const RawSeries& rows, const Grid& grid, Hold hold) {
  Samples slots(grid.size, kMissing);
  if (hold == Hold::sample) {
    place_samples(rows, grid, slots);
  } else {
    place_steps(rows, grid, slots);
  }
  for (double& value : slots) {
    if (!std::isfinite(value)) value = kMissing;
  }
  return slots;
}

std::size_t count_repeated_times(const RawSeries& rows) {
  std::size_t repeated = 0;
  for (std::size_t row = 1; row < rows.time_us.size(); ++row) {
    if (rows.time_us[row] == rows.time_us[row - 1]) ++repeated;
  }
  return repeated;
}

double usual_interval_s(const RawSeries& rows) {
  std::vector<std::int64_t> spacings;
  for (std::size_t row = 1; row < rows.time_us.size(); ++row) {
    const std::int64_t spacing = rows.time_us[row] - rows.time_us[row - 1];
    if (spacing > 0) spacings.push_back(spacing);
  }
  if (spacings.empty()) return 0.0;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return static_cast<double>(*middle) / kMicrosecondsPerSecond;
}

}  // namespace loopscope::core::signal
