#include "storage/historian/merge_series.hpp"

#include <algorithm>
#include <utility>

#include "core/signal/grid.hpp"
#include "core/signal/microseconds.hpp"

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using Row = std::pair<std::int64_t, double>;

/// Rows of a series that is written lie no further apart than this many times the usual spacing.
constexpr double kAliveSpacings = 3.0;

/// Whether `series` has rows closely before and after a time.
bool alive_at(const RawSeries& series, std::int64_t time_us, double usual_us) {
  const auto& times = series.time_us;
  const auto after = std::upper_bound(times.begin(), times.end(), time_us);
  if (after == times.begin() || after == times.end()) return false;
  return core::signal::elapsed_us(*std::prev(after), *after) <= kAliveSpacings * usual_us;
}

std::vector<Row> sorted_rows(const std::vector<RawSeries>& parts) {
  std::vector<double> usual_us;
  for (const RawSeries& part : parts) {
    usual_us.push_back(core::signal::usual_interval_s(part) * core::signal::kMicrosecondsPerSecond);
  }
  std::vector<Row> rows;
  for (std::size_t id = 0; id < parts.size(); ++id) {
    for (std::size_t k = 0; k < parts[id].time_us.size(); ++k) {
      const std::int64_t time_us = parts[id].time_us[k];
      bool superseded = false;
      for (std::size_t later = id + 1; later < parts.size() && !superseded; ++later) {
        superseded = alive_at(parts[later], time_us, usual_us[later]);
      }
      if (!superseded) rows.emplace_back(time_us, parts[id].value[k]);
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.first < b.first; });
  return rows;
}

}  // namespace

RawSeries merge_series(std::vector<RawSeries> parts, const TagRequest& request) {
  if (parts.empty()) return {};
  if (parts.size() == 1) return std::move(parts.front());
  const std::vector<Row> rows = sorted_rows(parts);
  const auto in_span = std::partition_point(
      rows.begin(), rows.end(), [&](const Row& row) { return row.first < request.from_us; });
  auto first = in_span == rows.begin() ? in_span : std::prev(in_span);
  if (rows.end() - in_span > request.max_rows) first = rows.end() - request.max_rows;
  RawSeries merged;
  for (auto row = first; row != rows.end(); ++row) {
    merged.time_us.push_back(row->first);
    merged.value.push_back(row->second);
  }
  for (const RawSeries& part : parts) merged.unknown_quality += part.unknown_quality;
  merged.merged = true;
  return merged;
}

}  // namespace loopscope::storage
