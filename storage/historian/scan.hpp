#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "storage/historian/find_tags.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/tag_request.hpp"

namespace loopscope::storage {

inline constexpr std::int64_t kHour_us = std::int64_t{3600} * 1'000'000;
inline constexpr std::int64_t kDay_us = std::int64_t{24} * kHour_us;

/// The spans in which a newest row is looked for, one after the other: each begins earlier and all
/// end at one time, so that the first that has a row gives the same as the last. A server that
/// sorts what it is asked for, or opens every partition of it, then has to do with few rows more
/// than lie between two rows of the tag. A tag that is recorded has a row in an hour, a step of a
/// setpoint or a day's batch in a day; a month and a year are what historians keep in one
/// partition.
inline constexpr std::array<std::int64_t, 4> kGrowingSpans_us{
    kHour_us, kDay_us, std::int64_t{31} * kDay_us, kReachBefore_us};

/// Whom the values of one column of a scan are for: place `place` of request `request`.
struct ScanTarget {
  std::size_t request = 0;
  std::size_t place = 0;
};

/// One value column of a scan.
struct ScanColumn {
  std::string value;    ///< SQL of the double (value_of)
  bool before = false;  ///< also the newest row before the span
  std::vector<ScanTarget> targets;
};

/// One pass over the rows of a key in a span of time. Tags that share their rows (columns of one
/// loop or of one wide table, one tag of several loops) share the scan.
struct Scan {
  std::vector<std::string> key;  ///< one native text per part (TagPlace)
  std::int64_t from_us = 0;      ///< microseconds UTC; both ends belong to it
  std::int64_t to_us = 0;
  std::int64_t max_rows = 0;  ///< newest so many rows of the span, > 0
  std::vector<ScanColumn> columns;
};

/// Whether the row before is wanted of any of the columns.
[[nodiscard]] bool wants_before(const Scan& scan);

/// What the statement of a batch (not empty) reads: the columns of its scans, each with the row
/// before where any of them wants it.
[[nodiscard]] std::vector<ScanColumn> columns_of(const std::vector<Scan>& batch);

/// Scans that one statement reads: all of them have the same columns. `places` are those of
/// `requests` (find_tags). Every request's places are in some batch, unless its column holds no
/// values. Batches keep to what a round trip should carry (rows and columns). Throws DatabaseError
/// for a column whose name cannot be quoted.
[[nodiscard]] std::vector<std::vector<Scan>> plan_scans(
    const PqConnection& connection, const ResolvedLayout& layout,
    std::span<const TagRequest> requests, std::span<const std::vector<TagPlace>> places);

}  // namespace loopscope::storage
