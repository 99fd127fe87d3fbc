#include "core/signal/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/signal/microseconds.hpp"
#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {
namespace {

/// a - b for a >= b: the difference always fits into the unsigned type.
std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b);
}

/// Slot whose time is nearest to `time_us`; may lie outside the grid.
double nearest_slot(const Grid& grid, std::int64_t time_us) {
  const double offset_us = elapsed_us(grid.start_us, time_us);
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

/// Fills the slots from the time of one row on up to, but without, that of the next by the line
/// between them.
void draw_line(const RawSeries& rows, std::size_t row, const Grid& grid, Samples& slots) {
  const double interval_us = grid.sample_interval_s * kMicrosecondsPerSecond;
  const double from = elapsed_us(grid.start_us, rows.time_us[row]) / interval_us;
  const double to = elapsed_us(grid.start_us, rows.time_us[row + 1]) / interval_us;
  const double end = std::min(to, static_cast<double>(grid.size));
  for (double k = std::max(std::ceil(from), 0.0); k < end; k += 1.0) {
    const double share = (k - from) / (to - from);
    slots[static_cast<std::size_t>(k)] =
        rows.value[row] + share * (rows.value[row + 1] - rows.value[row]);
  }
}

void place_lines(const RawSeries& rows, const Grid& grid, Samples& slots) {
  // A row next to a line that nobody knows still says what the value was in its own slot.
  place_samples(rows, grid, slots);
  for (std::size_t row = 0; row + 1 < rows.time_us.size(); ++row) {
    const bool known = std::isfinite(rows.value[row]) && std::isfinite(rows.value[row + 1]);
    if (known) draw_line(rows, row, grid, slots);
  }
}

}  // namespace

double elapsed_us(std::int64_t from_us, std::int64_t to_us) {
  return to_us >= from_us ? static_cast<double>(distance(to_us, from_us))
                          : -static_cast<double>(distance(from_us, to_us));
}

std::int64_t moved_us(std::int64_t time_us, double offset_us) {
  constexpr auto kEarliest = std::numeric_limits<std::int64_t>::min();
  constexpr auto kLatest = std::numeric_limits<std::int64_t>::max();
  const double size_us = std::round(std::abs(offset_us));
  // Where rounding raises a room, the next smaller double already fits into it.
  if (offset_us < 0.0) {
    const std::uint64_t room = distance(time_us, kEarliest);
    if (size_us >= static_cast<double>(room)) return kEarliest;
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(time_us) -
                                     static_cast<std::uint64_t>(size_us));
  }
  const std::uint64_t room = distance(kLatest, time_us);
  if (size_us >= static_cast<double>(room)) return kLatest;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(time_us) +
                                   static_cast<std::uint64_t>(size_us));
}

std::int64_t Grid::time_us(std::size_t k) const {
  return moved_us(start_us, static_cast<double>(k) * sample_interval_s * kMicrosecondsPerSecond);
}

Samples align(const RawSeries& rows, const Grid& grid, Hold hold) {
  Samples slots(grid.size, kMissing);
  switch (hold) {
    case Hold::sample:
      place_samples(rows, grid, slots);
      break;
    case Hold::step:
      place_steps(rows, grid, slots);
      break;
    case Hold::linear:
      place_lines(rows, grid, slots);
      break;
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
  std::vector<double> spacings_us;
  for (std::size_t row = 1; row < rows.time_us.size(); ++row) {
    const double spacing_us = elapsed_us(rows.time_us[row - 1], rows.time_us[row]);
    if (spacing_us > 0.0) spacings_us.push_back(spacing_us);
  }
  return spacings_us.empty() ? 0.0 : median(std::move(spacings_us)) / kMicrosecondsPerSecond;
}

}  // namespace loopscope::core::signal
