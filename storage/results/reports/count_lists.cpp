#include "storage/results/reports/count_lists.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

namespace loopscope::storage {
namespace {

/// A page with more is not read to its end.
constexpr std::size_t kMostAnnotations = 30;

template <typename Fits>
std::int64_t loops_that(std::span<const HiddenLoopRow> hidden, const Fits& fits) {
  std::set<std::int64_t> loops;
  for (const HiddenLoopRow& row : hidden)
    if (fits(row)) loops.insert(row.loop_id);
  return static_cast<std::int64_t>(loops.size());
}

bool by_people(const HiddenLoopRow& row) {
  return row.annotation_id.has_value();
}

}  // namespace

void count_lists(std::span<const FlaggedRow> flagged, std::span<const HiddenLoopRow> hidden,
                 std::int64_t since_us, PlantCounts& counts) {
  counts.flagged = static_cast<std::int64_t>(flagged.size());
  counts.new_flags = std::ranges::count_if(
      flagged, [&](const FlaggedRow& row) { return row.began_after(since_us); });
  const auto is_victim = [](const HiddenLoopRow& row) { return row.said.hidden_by == "victim"; };
  counts.victims = loops_that(hidden, is_victim);
  counts.annotated = loops_that(hidden, by_people);
  counts.unlisted = loops_that(
      hidden, [&](const HiddenLoopRow& row) { return !by_people(row) && !is_victim(row); });
  std::ranges::copy_if(hidden, std::back_inserter(counts.newest_annotations), by_people);
  counts.annotations = static_cast<std::int64_t>(counts.newest_annotations.size());
  std::ranges::sort(
      counts.newest_annotations, std::ranges::greater(),
      [](const HiddenLoopRow& row) { return std::tuple(row.said.entered_us, row.annotation_id); });
  if (counts.newest_annotations.size() > kMostAnnotations)
    counts.newest_annotations.resize(kMostAnnotations);
}

}  // namespace loopscope::storage
