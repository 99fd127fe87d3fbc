#pragma once

#include <cstdint>
#include <string>

namespace loopscope::storage {

/// How far back a row before the window is looked for, microseconds: a setpoint may stand still for
/// months.
inline constexpr std::int64_t kReachBefore_us = std::int64_t{366} * 24 * 3600 * 1'000'000;

/// Whether the newest row before a span is wanted too.
enum class RowBefore {
  no,
  if_held,  ///< when the tag's archive holds values or draws lines between rows
  yes,
};

/// The rows of one tag that a window needs.
struct TagRequest {
  std::string tag;
  std::int64_t from_us = 0;   ///< first time wanted, microseconds UTC, inclusive
  std::int64_t to_us = 0;     ///< last time wanted, inclusive
  std::int64_t max_rows = 0;  ///< newest so many rows of the span, > 0
  RowBefore before = RowBefore::no;
  bool mode = false;  ///< the values are modes: to be read by the layout's ModeCodes
};

}  // namespace loopscope::storage
