#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/historian/binary_array.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// A historian's time column in its own unit. Bounds are sent in that unit and results converted
/// here, because a conversion in SQL would keep the server from using its index.

/// SQL type that bounds and results travel as.
[[nodiscard]] const char* native_type(TimeKind kind);

/// Types that the column may have, as pg_type calls them.
[[nodiscard]] std::vector<std::string> time_column_types(TimeKind kind);

/// Element type of an array of it.
[[nodiscard]] ElementType native_element(TimeKind kind);

enum class Bound { lower, upper };

/// Text of the first (lower) or last (upper) native value that lies in a span which begins or ends
/// at `time_us` inclusive. What lies outside the years 1 to 9999 (and, of nanoseconds, outside
/// eight bytes) becomes the nearest end, here and in native_text().
[[nodiscard]] std::string native_bound(TimeKind kind, std::int64_t time_us, Bound bound);

/// Text of `time_us` as it is stored, rounded down to the unit.
[[nodiscard]] std::string native_text(TimeKind kind, std::int64_t time_us);

/// Microseconds UTC of a value in binary form (decode_value). What does not fit becomes
/// kEarliestTimeUs or kLatestTimeUs.
[[nodiscard]] std::int64_t microseconds(TimeKind kind, std::uint64_t native_bits);

}  // namespace loopscope::storage
