#include "storage/historian/native_time.hpp"

#include <bit>
#include <cmath>

#include "storage/array_literal.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// PostgreSQL counts from 2000-01-01.
constexpr std::int64_t kPostgresEpochUs = 946'684'800'000'000;
constexpr double kMicrosecondsPerSecond = 1e6;

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
    case TimeKind::epoch_s_float:
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
  return number_text((static_cast<double>(time_us) + half) / kMicrosecondsPerSecond);
}

}  // namespace

const char* native_type(TimeKind kind) {
  switch (kind) {
    case TimeKind::timestamptz:
      return "timestamptz";
    case TimeKind::timestamp_utc:
      return "timestamp";
    case TimeKind::epoch_s_float:
      return "float8";
    case TimeKind::epoch_s:
    case TimeKind::epoch_ms:
    case TimeKind::epoch_us:
      return "int8";
  }
  return "int8";
}

ElementType native_element(TimeKind kind) {
  switch (kind) {
    case TimeKind::timestamptz:
      return ElementType::timestamptz;
    case TimeKind::timestamp_utc:
      return ElementType::timestamp;
    case TimeKind::epoch_s_float:
      return ElementType::float8;
    case TimeKind::epoch_s:
    case TimeKind::epoch_ms:
    case TimeKind::epoch_us:
      return ElementType::int8;
  }
  return ElementType::int8;
}

std::string native_bound(TimeKind kind, std::int64_t time_us, Bound bound) {
  const std::int64_t time = clamp_time(time_us);
  if (kind == TimeKind::epoch_s_float) return float_bound(time, bound);
  const std::int64_t unit = unit_us(kind);
  if (unit == 0) return timestamp_text(time);
  const std::int64_t round_up = bound == Bound::lower ? unit - 1 : 0;
  return std::to_string(divide_down(time + round_up, unit));
}

std::string native_text(TimeKind kind, std::int64_t time_us) {
  if (kind == TimeKind::epoch_s_float) {
    return number_text(static_cast<double>(clamp_time(time_us)) / kMicrosecondsPerSecond);
  }
  return native_bound(kind, time_us, Bound::upper);
}

std::int64_t microseconds(TimeKind kind, std::uint64_t native_bits) {
  if (kind == TimeKind::epoch_s_float) {
    return std::llround(std::bit_cast<double>(native_bits) * kMicrosecondsPerSecond);
  }
  const auto value = std::bit_cast<std::int64_t>(native_bits);
  const std::int64_t unit = unit_us(kind);
  return unit == 0 ? value + kPostgresEpochUs : value * unit;
}

}  // namespace loopscope::storage
