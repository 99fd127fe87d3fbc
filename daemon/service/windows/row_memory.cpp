#include "daemon/service/windows/row_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;
using storage::TagRequest;

/// Place of the first row that is not before `time_us`.
std::size_t first_from(const RawSeries& rows, std::int64_t time_us) {
  return static_cast<std::size_t>(std::ranges::lower_bound(rows.time_us, time_us) -
                                  rows.time_us.begin());
}

void append(RawSeries& rows, const RawSeries& more, std::size_t first, std::size_t last) {
  const auto part = [&](const auto& values) {
    return std::pair{values.begin() + static_cast<std::ptrdiff_t>(first),
                     values.begin() + static_cast<std::ptrdiff_t>(last)};
  };
  const auto [time, time_end] = part(more.time_us);
  const auto [value, value_end] = part(more.value);
  rows.time_us.insert(rows.time_us.end(), time, time_end);
  rows.value.insert(rows.value.end(), value, value_end);
}

/// Drops the oldest rows of the span that are more than were asked for; a row before it stays.
void trim(RawSeries& rows, const TagRequest& request) {
  const std::size_t before = first_from(rows, request.from_us);
  const std::size_t inside = rows.time_us.size() - before;
  const auto wanted = static_cast<std::size_t>(std::max<std::int64_t>(request.max_rows, 0));
  if (inside <= wanted) return;
  const auto from = static_cast<std::ptrdiff_t>(before);
  const auto to = from + static_cast<std::ptrdiff_t>(inside - wanted);
  rows.time_us.erase(rows.time_us.begin() + from, rows.time_us.begin() + to);
  rows.value.erase(rows.value.begin() + from, rows.value.begin() + to);
}

RawSeries join(RawSeries head, const RawSeries& later, std::int64_t later_from_us,
               const TagRequest& request) {
  head.hold = later.hold;
  head.unknown_quality += later.unknown_quality;
  append(head, later, first_from(later, later_from_us), first_from(later, request.to_us + 1));
  trim(head, request);
  return head;
}

}  // namespace

/// Only where the later part is whole: not cut off by its number of rows, and not of an archive
/// whose lines need the row after the span.
const RowMemory::Known* RowMemory::later_part(const TagRequest& request) const {
  const auto found = known_.find({request.tag, request.mode});
  if (found == known_.end()) return nullptr;
  const Known& known = found->second;
  const bool overlaps = request.from_us <= known.request.from_us &&
                        known.request.from_us <= request.to_us &&
                        request.to_us <= known.request.to_us;
  const std::size_t inside =
      known.rows.time_us.size() - first_from(known.rows, known.request.from_us);
  const bool whole = static_cast<std::int64_t>(inside) < known.request.max_rows &&
                     known.rows.hold != core::signal::Hold::linear;
  return overlaps && whole ? &known : nullptr;
}

void RowMemory::remember(const TagRequest& request, const RawSeries& rows) {
  known_.try_emplace({request.tag, request.mode}, Known{request, rows});
}

std::vector<RawSeries> RowMemory::read(std::span<const TagRequest> requests, const Read& read) {
  if (requests.empty()) return {};
  std::vector<const Known*> later;
  std::vector<TagRequest> missing(requests.begin(), requests.end());
  for (TagRequest& request : missing) {
    const Known* known = later.emplace_back(later_part(request));
    if (known != nullptr) request.to_us = known->request.from_us - 1;
  }
  std::vector<RawSeries> series = read(missing);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (later[k] != nullptr) {
      series[k] =
          join(std::move(series[k]), later[k]->rows, later[k]->request.from_us, requests[k]);
    }
  }
  for (std::size_t k = 0; k < requests.size(); ++k) remember(requests[k], series[k]);
  return series;
}

}  // namespace loopscope::daemon
