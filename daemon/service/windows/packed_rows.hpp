#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/signal/raw_series.hpp"

namespace loopscope::daemon {

/// Rows of one tag in little memory, without loss. What is alike from row to row is laid side by
/// side for zstd: second differences of the times (nothing is left of a regular interval), values
/// on a decimal grid as differences of whole numbers, all by their bytes, so that signs and
/// exponents, and the empty low bytes of single precision, take next to nothing. Of 4096 regular
/// rows a value at rest takes some 100 bytes in all, a grid of hundredths a byte and a half a row,
/// single precision four and random mantissas of double precision seven (daemon/MEASURED.md).
class PackedRows {
 public:
  PackedRows() = default;
  /// Throws std::bad_alloc.
  explicit PackedRows(const core::signal::RawSeries& rows);

  /// Exactly what was packed, bit for bit. Throws std::bad_alloc.
  [[nodiscard]] core::signal::RawSeries unpack() const;

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] core::signal::Hold hold() const { return hold_; }
  [[nodiscard]] std::size_t bytes() const { return sizeof(*this) + packed_.capacity(); }

 private:
  std::string packed_;
  std::uint32_t rows_ = 0;
  std::int8_t decimals_ = 0;  ///< of the grid of values; negative = values are kept as they are
  core::signal::Hold hold_ = core::signal::Hold::sample;
};

}  // namespace loopscope::daemon
