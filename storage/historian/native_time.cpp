#include "storage/historian/native_time.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/signal/microseconds.hpp"
#include "storage/array_literal.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// PostgreSQL counts from 2000-01-01.
constexpr std::int64_t kPostgresEpochUs = 946'684'800'000'000;
constexpr std::int64_t kNanoseconds = 1000;  // of a microsecond

/// Microseconds in one unit of a whole-number column; 0 = the column is no such one.
std::int64_t unit_us(TimeKind kind) {
  switch (kind) {
    case TimeKind::epoch_s:
      return 1'000'000;
    case TimeKind::epoch_ms:
      return 1'000;
    case TimeKind::epoch_us:
      return 1;
    case TimeKind::timestamptz:
    case TimeKind::timestamp_utc:
    case TimeKind::timestamp_local:
    case TimeKind::epoch_s_float:
    case TimeKind::epoch_ns:
      return 0;
  }
  return 0;
}

std::int64_t divide_down(std::int64_t value, std::int64_t unit) {
  const std::int64_t quotient = value / unit;
  return value % unit < 0 ? quotient - 1 : quotient;
}

/// Seconds as a double hold microseconds only to a few tenths: a bound that was itself read from
/// such a column must not miss its own row, so it is widened by half a microsecond.
std::string float_bound(std::int64_t time_us, Bound bound) {
  const double half = bound == Bound::lower ? -0.5 : 0.5;
  return number_text((static_cast<double>(time_us) + half) / core::signal::kMicrosecondsPerSecond);
}

/// All nanoseconds of the microsecond belong to it; years beyond 2262 do not fit into the type.
std::string nanoseconds_bound(std::int64_t time_us, Bound bound) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / kNanoseconds - 1;
  const std::int64_t time = std::clamp(time_us, -kMost, kMost);
  return std::to_string(time * kNanoseconds + (bound == Bound::lower ? 0 : kNanoseconds - 1));
}

}  // namespace

const char* native_type(TimeKind kind) {
  switch (kind) {
    case TimeKind::timestamptz:
    case TimeKind::timestamp_local:
      return "timestamptz";
    case TimeKind::timestamp_utc:
      return "timestamp";
    case TimeKind::epoch_s_float:
      return "float8";
    case TimeKind::epoch_s:
    case TimeKind::epoch_ms:
    case TimeKind::epoch_us:
    case TimeKind::epoch_ns:
      return "int8";
  }
  return "int8";
}

std::vector<std::string> time_column_types(TimeKind kind) {
  if (kind == TimeKind::timestamp_local) return {"timestamp"};
  const std::string type = native_type(kind);
  // Shorter whole numbers compare with int8 by the same index.
  return type == "int8" ? std::vector<std::string>{type, "int4"} : std::vector<std::string>{type};
}

ElementType native_element(TimeKind kind) {
  switch (kind) {
    case TimeKind::timestamptz:
    case TimeKind::timestamp_local:
      return ElementType::timestamptz;
    case TimeKind::timestamp_utc:
      return ElementType::timestamp;
    case TimeKind::epoch_s_float:
      return ElementType::float8;
    case TimeKind::epoch_s:
    case TimeKind::epoch_ms:
    case TimeKind::epoch_us:
    case TimeKind::epoch_ns:
      return ElementType::int8;
  }
  return ElementType::int8;
}

std::string native_bound(TimeKind kind, std::int64_t time_us, Bound bound) {
  const std::int64_t time = clamp_time(time_us);
  if (kind == TimeKind::epoch_s_float) return float_bound(time, bound);
  if (kind == TimeKind::epoch_ns) return nanoseconds_bound(time, bound);
  const std::int64_t unit = unit_us(kind);
  if (unit == 0) return timestamp_text(time);
  const std::int64_t round_up = bound == Bound::lower ? unit - 1 : 0;
  return std::to_string(divide_down(time + round_up, unit));
}

std::string native_text(TimeKind kind, std::int64_t time_us) {
  if (kind == TimeKind::epoch_s_float) {
    return number_text(static_cast<double>(clamp_time(time_us)) /
                       core::signal::kMicrosecondsPerSecond);
  }
  return native_bound(kind, time_us, kind == TimeKind::epoch_ns ? Bound::lower : Bound::upper);
}

std::int64_t microseconds(TimeKind kind, std::uint64_t native_bits) {
  if (kind == TimeKind::epoch_s_float) {
    const double time_us =
        std::bit_cast<double>(native_bits) * core::signal::kMicrosecondsPerSecond;
    if (!(time_us > static_cast<double>(kEarliestTimeUs))) return kEarliestTimeUs;
    return time_us < static_cast<double>(kLatestTimeUs) ? std::llround(time_us) : kLatestTimeUs;
  }
  const auto value = std::bit_cast<std::int64_t>(native_bits);
  if (kind == TimeKind::epoch_ns) return divide_down(value, kNanoseconds);
  const std::int64_t unit = unit_us(kind);
  std::int64_t time_us = 0;
  if (unit == 0 && !__builtin_add_overflow(value, kPostgresEpochUs, &time_us)) return time_us;
  if (unit == 0) return kLatestTimeUs;
  // What does not fit lies beyond every calendar: the nearest end of what does.
  if (!__builtin_mul_overflow(value, unit, &time_us)) return time_us;
  return value < 0 ? kEarliestTimeUs : kLatestTimeUs;
}

}  // namespace loopscope::storage
