#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// What the historian holds of one tag of a loop, as far as it tells whether the tag is alive.
struct TagReading {
  std::string_view role;                      ///< sp, pv, op, mv or mode
  std::optional<std::int64_t> newest_row_us;  ///< not in the future; nullopt = no row at all
  std::int64_t asked_us = 0;                  ///< the historian's clock then
  std::size_t future_rows = 0;   ///< stamped later than the clock allows; never read as data
  std::size_t rows = 0;          ///< read for the window
  std::size_t bad_rows = 0;      ///< of those, of bad quality or no number
  std::size_t surplus_rows = 0;  ///< the window was cut off at so many rows; 0 = it was not
  std::size_t unknown_rows = 0;  ///< of those, with a quality code that nobody knows
};

using TagReadings = std::vector<TagReading>;

/// The reading of a role; nullptr when the loop has no such tag.
[[nodiscard]] inline const TagReading* find_reading(const TagReadings& readings,
                                                    std::string_view role) {
  for (const TagReading& reading : readings) {
    if (reading.role == role) return &reading;
  }
  return nullptr;
}

}  // namespace loopscope::daemon
