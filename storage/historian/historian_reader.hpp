#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/historian/narrow_layout.hpp"

namespace loopscope::storage {

/// The rows of one tag that a window needs.
struct TagRequest {
  std::string tag;
  std::int64_t from_us = 0;   ///< first time wanted, microseconds UTC, inclusive
  std::int64_t to_us = 0;     ///< last time wanted, inclusive
  std::int64_t max_rows = 0;  ///< newest so many rows of the span, > 0
  bool before = false;        ///< also the newest row before `from_us` (values recorded on change)
};

/// Reads a historian in the narrow layout over one connection: binary arrays, many tags a round
/// trip. Not shared between threads. Every function throws DatabaseError.
class HistorianReader {
 public:
  /// Connects read-only and checks that relation and columns exist with usable types.
  HistorianReader(const ConnectionSettings& settings, const NarrowLayout& layout);
  ~HistorianReader();
  HistorianReader(HistorianReader&&) noexcept;
  HistorianReader& operator=(HistorianReader&&) noexcept;

  /// Rows of each request in ascending time, bad quality as NaN; empty for an unknown tag.
  [[nodiscard]] std::vector<core::signal::RawSeries> read(std::span<const TagRequest> requests);
  /// Time of each tag's newest row not after `not_after_us`; nullopt for a tag without rows.
  [[nodiscard]] std::vector<std::optional<std::int64_t>> newest(std::span<const std::string> tags,
                                                                std::int64_t not_after_us);
  /// The database's clock, microseconds UTC.
  [[nodiscard]] std::int64_t now_us();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
