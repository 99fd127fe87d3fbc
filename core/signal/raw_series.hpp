#pragma once

#include <cstdint>
#include <vector>

namespace loopscope::core::signal {

/// The rows of one tag as the historian or a file holds them, in ascending time.
///
/// Equal lengths. A row whose quality is bad or whose value is NULL, NaN or infinite carries NaN.
/// A repeated time is allowed: the last row counts.
struct RawSeries {
  std::vector<std::int64_t> time_us;  ///< microseconds UTC since 1970
  std::vector<double> value;          ///< NaN = bad or missing

  [[nodiscard]] bool empty() const { return time_us.empty(); }
};

}  // namespace loopscope::core::signal
