#include "tests/fuzz/historian_answer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#include "storage/historian/native_time.hpp"
#include "tests/fuzz/odd_number.hpp"

namespace loopscope::tests::fuzz {
namespace {

using storage::ElementType;
using storage::TimeKind;

constexpr std::uint64_t kNull = 0xDEAD'0000'0000'0001;
constexpr std::size_t kMostRows = 24;
/// 2026-01-01.
constexpr std::int64_t kStart_us = 1'767'225'600'000'000;

constexpr std::array kKinds = {TimeKind::timestamptz,     TimeKind::timestamp_utc,
                               TimeKind::timestamp_local, TimeKind::epoch_s,
                               TimeKind::epoch_s_float,   TimeKind::epoch_ms,
                               TimeKind::epoch_us,        TimeKind::epoch_ns};

/// The value of a time column for a whole second.
std::uint64_t native_bits(TimeKind kind, std::int64_t second) {
  constexpr std::int64_t kPostgresEpoch_s = 946'684'800;
  switch (kind) {
    case TimeKind::epoch_s:
      return std::bit_cast<std::uint64_t>(second);
    case TimeKind::epoch_s_float:
      return std::bit_cast<std::uint64_t>(static_cast<double>(second));
    case TimeKind::epoch_ms:
      return std::bit_cast<std::uint64_t>(second * 1000);
    case TimeKind::epoch_us:
      return std::bit_cast<std::uint64_t>(second * 1'000'000);
    case TimeKind::epoch_ns:
      return std::bit_cast<std::uint64_t>(second * 1'000'000'000);
    case TimeKind::timestamptz:
    case TimeKind::timestamp_utc:
    case TimeKind::timestamp_local:
      return std::bit_cast<std::uint64_t>((second - kPostgresEpoch_s) * 1'000'000);
  }
  return 0;
}

storage::Scan make_scan(ByteSource& source, bool sane) {
  storage::Scan scan{{"tag"}, kStart_us, kStart_us + 1'000'000'000, 1000, {}};
  if (!sane) {
    scan.from_us = source.number<std::int64_t>();
    scan.to_us = source.number<std::int64_t>();
    scan.max_rows = source.number<std::int16_t>();
  }
  scan.columns.resize(1 + source.byte() % 3);
  for (storage::ScanColumn& column : scan.columns) column.before = source.truth();
  return scan;
}

Cell any_cell(ByteSource& source) {
  const std::uint8_t choice = source.byte();
  if (choice % 8 == 0) return std::nullopt;
  const std::string text = source.text(200);
  const auto bytes = std::as_bytes(std::span(text));
  return Bytes(bytes.begin(), bytes.end());
}

std::uint64_t value_bits(ByteSource& source) {
  return source.byte() % 8 == 0 ? kNull : std::bit_cast<std::uint64_t>(odd_number(source));
}

std::vector<Cell> sane_row(ByteSource& source, TimeKind kind, const storage::Scan& scan) {
  constexpr std::int64_t kSecond_us = 1'000'000;
  const std::size_t count = source.byte() % kMostRows;
  std::vector<std::int64_t> seconds(count);
  // Few different times, so that some are repeated.
  for (std::int64_t& second : seconds) second = kStart_us / kSecond_us + source.byte() % 32;
  std::sort(seconds.begin(), seconds.end(), std::greater());
  std::vector<std::uint64_t> times;
  for (const std::int64_t second : seconds) times.push_back(native_bits(kind, second));
  std::vector<Cell> row{value_bytes(1)};
  const bool none = times.empty() && source.truth();
  row.push_back(none ? Cell() : array_bytes(storage::native_element(kind), times, kNull));
  row.push_back(value_bytes(source.byte()));
  for (std::size_t column = 0; column < scan.columns.size(); ++column) {
    std::vector<std::uint64_t> values(count);
    for (std::uint64_t& value : values) value = value_bits(source);
    row.push_back(none ? Cell() : array_bytes(ElementType::float8, values, kNull));
  }
  for (const storage::ScanColumn& column : scan.columns) {
    if (!column.before) continue;
    const bool found = source.truth();
    const std::int64_t second = kStart_us / kSecond_us - 1 - source.byte();
    row.push_back(found ? Cell(value_bytes(native_bits(kind, second))) : Cell());
    const std::uint64_t value = value_bits(source);
    row.push_back(found && value != kNull ? Cell(value_bytes(value)) : Cell());
  }
  return row;
}

/// Cells of a sane row, some of them replaced.
std::vector<Cell> any_row(ByteSource& source, TimeKind kind, const storage::Scan& scan) {
  std::vector<Cell> row = sane_row(source, kind, scan);
  for (Cell& cell : row) {
    const std::uint8_t choice = source.byte();
    if (choice % 4 == 0) cell = any_cell(source);
    if (choice % 4 != 1 || !cell || cell->empty()) continue;
    (*cell)[source.below(cell->size())] = static_cast<std::byte>(source.byte());
  }
  return row;
}

}  // namespace

HistorianAnswer make_answer(ByteSource& source) {
  const bool sane = source.byte() % 4 != 0;
  storage::ResolvedLayout layout;
  layout.layout.time_kind = kKinds[source.byte() % kKinds.size()];
  layout.layout.null_is_absent = source.truth();
  if (!sane && source.truth()) layout.tiebreak = "h.\"n\"";
  // Beside nanoseconds the time column holds full seconds.
  if (!sane && source.truth()) layout.nanos = "h.\"ns\"";
  layout.key.push_back({"h.\"tag\"", "text", std::nullopt});
  storage::Scan scan = make_scan(source, sane);
  if (!sane) scan.key.front() = source.text(30);
  std::vector<std::vector<Cell>> rows(1 + source.byte() % 3);
  for (std::vector<Cell>& row : rows) {
    const TimeKind kind = layout.layout.time_kind;
    row = sane ? sane_row(source, kind, scan) : any_row(source, kind, scan);
  }
  return {std::move(layout), scan, answer(rows), sane};
}

}  // namespace loopscope::tests::fuzz
