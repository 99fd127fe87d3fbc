#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// A tag, and whether its values are read as modes.
using TagKey = std::pair<std::string, bool>;

/// All rows of a tag from one time to another, both included, microseconds UTC.
struct KnownRows {
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
  /// The newest row before the span was asked for and stands before the others, where there is one.
  bool before_known = false;
  core::signal::RawSeries rows;
};

/// Rows that are known already, so that a request asks the historian only for those before and
/// after them: the windows of neighbouring slots are nearly the same. They are those that a batch
/// has read, and those that were kept from the last visit (WindowCache). Gives exactly the rows
/// that reading the whole span would give, as long as what is known is still true.
class RowMemory {
 public:
  using Read = std::function<std::vector<core::signal::RawSeries>(
      std::span<const storage::TagRequest> requests)>;

  /// Rows of each request, in order. `read` is called at most twice: for what is missing, and for
  /// whole spans where what came does not fit to what is known.
  [[nodiscard]] std::vector<core::signal::RawSeries> read(
      std::span<const storage::TagRequest> requests, const Read& read);

  /// Rows that were read before. Of a tag that is known already only what both hold stays: whoever
  /// kept less of it wants the rest read again.
  void know(const std::string& tag, bool mode, KnownRows rows);
  /// What is known of a tag, or nullptr. Valid until the next read().
  [[nodiscard]] const KnownRows* find(const std::string& tag, bool mode) const;

 private:
  struct Pieces;
  [[nodiscard]] Pieces pieces_of(const storage::TagRequest& request) const;
  std::vector<core::signal::RawSeries> read_pieces(std::span<const storage::TagRequest> requests,
                                                   std::vector<Pieces>& pieces, const Read& read);
  void remember(const storage::TagRequest& request, const core::signal::RawSeries& rows);

  std::map<TagKey, KnownRows> known_;
};

/// A lower bound for rows_within() that leaves out none.
inline constexpr std::int64_t kBeforeAll_us = std::numeric_limits<std::int64_t>::min();

/// Rows from `from_us` on up to and with `to_us`.
[[nodiscard]] core::signal::RawSeries rows_within(const core::signal::RawSeries& rows,
                                                  std::int64_t from_us, std::int64_t to_us);

/// The part of what is known from `from_us` on up to and with `to_us`, with the row before it.
[[nodiscard]] KnownRows later_part(const KnownRows& known, std::int64_t from_us,
                                   std::int64_t to_us);

}  // namespace loopscope::daemon
