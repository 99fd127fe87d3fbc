#include "storage/historian/merge_series.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using Row = std::pair<std::int64_t, double>;

std::vector<Row> sorted_rows(const std::vector<RawSeries>& parts) {
  std::vector<Row> rows;
  for (const RawSeries& part : parts) {
    for (std::size_t k = 0; k < part.time_us.size(); ++k) {
      rows.emplace_back(part.time_us[k], part.value[k]);
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
  return merged;
}

}  // namespace loopscope::storage
