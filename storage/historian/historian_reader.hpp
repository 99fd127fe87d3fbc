#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/historian/source_layout.hpp"
#include "storage/historian/tag_request.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// Reads a historian of any layout over one connection: binary arrays, many tags a round trip. Not
/// shared between threads. Every function throws DatabaseError (after Remedy::reconnect the object
/// must be thrown away), and std::bad_alloc for an answer that does not fit into memory; each
/// statement waits patience() at most.
class HistorianReader {
 public:
  /// Connects read-only and checks that relations and columns exist with usable types.
  HistorianReader(const ConnectionSettings& settings, const SourceLayout& layout);
  ~HistorianReader();
  HistorianReader(HistorianReader&&) noexcept;
  HistorianReader& operator=(HistorianReader&&) noexcept;

  /// Rows of each request in ascending time, bad quality as NaN, and how the tag's archive keeps
  /// them; empty for an unknown tag. A repeated time stays: the last of its rows counts.
  [[nodiscard]] std::vector<core::signal::RawSeries> read(std::span<const TagRequest> requests);
  /// Time of each tag's newest row not after `not_after_us` (microseconds UTC) and no more than 30
  /// years before it; nullopt for a tag that is unknown or has no row there.
  [[nodiscard]] std::vector<std::optional<std::int64_t>> newest(std::span<const std::string> tags,
                                                                std::int64_t not_after_us);
  /// Calls `told` after every statement that was answered, on the thread that asked.
  void on_statement(std::function<void()> told);
  /// The database's clock.
  [[nodiscard]] ServerClock clock();
  /// The same without the server's start, microseconds UTC.
  [[nodiscard]] std::int64_t now_us() { return clock().now_us; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
