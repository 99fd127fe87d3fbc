#pragma once
/// Rows of a historian at given times.

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/signal/raw_series.hpp"

namespace loopscope::core::signal::tests {

inline constexpr std::int64_t kSecond = 1'000'000;  // microseconds

/// One row at each time; its value is its number.
[[nodiscard]] inline RawSeries rows_at(const std::vector<double>& times_s) {
  RawSeries rows;
  for (const double time_s : times_s) {
    rows.time_us.push_back(std::llround(time_s * static_cast<double>(kSecond)));
    rows.value.push_back(static_cast<double>(rows.value.size()));
  }
  return rows;
}

}  // namespace loopscope::core::signal::tests
