#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace loopscope::core::signal {

/// What a tag's value is between its rows.
enum class Hold {
  sample,  ///< nothing is known: a row fills only the slot it is nearest to (periodic recording)
  step,    ///< a row holds until the next one (setpoint, mode; recorded on change or by exception)
  linear,  ///< on the line to the next row (archives compressed by a swinging door)
};

/// The rows of one tag as the historian or a file holds them, in ascending time.
///
/// Equal lengths. A row whose quality is bad or whose value is NULL, NaN or infinite carries NaN.
/// A repeated time is allowed: the last row counts.
struct RawSeries {
  std::vector<std::int64_t> time_us;  ///< microseconds UTC since 1970
  std::vector<double> value;          ///< NaN = bad or missing
  Hold hold = Hold::sample;           ///< as the archive demands
  std::size_t unknown_quality = 0;    ///< rows whose quality code nobody knows: bad, and counted
  bool merged = false;  ///< of several ids of the tag: which rows count depends on all of them

  [[nodiscard]] bool empty() const { return time_us.empty(); }
};

}  // namespace loopscope::core::signal
