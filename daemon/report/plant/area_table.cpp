#include "daemon/report/plant/area_table.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "daemon/report/page/template.hpp"

namespace loopscope::daemon {
namespace {

void count(const storage::LoopRow& loop, AreaCounts& counts) {
  ++counts.loops;
  const std::string_view code = loop.code.value_or("");
  counts.not_controlling += code == "not_controlling" ? 1 : 0;
  counts.unjudgeable += code == "insufficient_data" ? 1 : 0;
  if (!loop.rank) return;
  ++counts.flagged;
  if (counts.best_rank == 0 || *loop.rank < counts.best_rank) counts.best_rank = *loop.rank;
}

std::string none_is_empty(std::int64_t number) {
  return number == 0 ? "" : std::to_string(number);
}

}  // namespace

std::string area_words(const std::string& area) {
  return area.empty() ? "Without an area" : area;
}

std::vector<AreaCounts> count_areas(const storage::ListedLoops& loops) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  std::map<std::pair<std::int64_t, std::string>, AreaCounts> by_place;
  for (const storage::LoopRow loop : loops) {
    if (!loop.enabled) continue;
    const std::string area(loop.area.value_or(""));
    AreaCounts& counts = by_place[{loop.area_place.value_or(kLast), area}];
    counts.area = area;
    count(loop, counts);
  }
  std::vector<AreaCounts> areas;
  for (auto& [place, counts] : by_place) areas.push_back(std::move(counts));
  if (std::ranges::all_of(areas, [](const AreaCounts& one) { return one.area.empty(); })) return {};
  return areas;
}

Markup area_table(std::span<const AreaCounts> areas,
                  const std::function<std::string(const AreaCounts&)>& link_to) {
  if (areas.empty()) return {};
  const auto fields = [&](const AreaCounts& one) {
    return Fields{{"link", link_to(one)},
                  {"area", area_words(one.area)},
                  {"loops", one.loops},
                  {"flagged", none_is_empty(one.flagged)},
                  {"best_rank", none_is_empty(one.best_rank)},
                  {"not_controlling", none_is_empty(one.not_controlling)},
                  {"unjudgeable", none_is_empty(one.unjudgeable)}};
  };
  return render("area_table", {{"areas", rows(areas, fields)}});
}

}  // namespace loopscope::daemon
