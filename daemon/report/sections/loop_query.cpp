#include "daemon/report/sections/loop_query.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace loopscope::daemon {
namespace {

using storage::LoopRow;

/// What a loop is put in order by; of a kind of order one of the two is set, or none.
struct Key {
  std::optional<double> number = {};
  std::optional<std::string_view> word = {};

  [[nodiscard]] bool is_none() const { return !number && !word; }
};

template <typename Number>
Key numbered(const std::optional<Number>& number, double sign = 1.0) {
  if (!number) return {};
  return {sign * static_cast<double>(*number)};
}

Key key_of(const LoopRow& loop, LoopOrder order) {
  switch (order) {
    case LoopOrder::rank:
      return numbered(loop.rank);
    case LoopOrder::name:
      return numbered(loop.name_place);
    case LoopOrder::area:
      return numbered(loop.area_place);
    case LoopOrder::unit:
      return numbered(loop.unit_place);
    case LoopOrder::verdict:
      return loop.code ? Key{{}, shown_verdict(loop)} : Key{};
    case LoopOrder::confidence:  // the surest first
      return numbered(loop.confidence, -1.0);
    case LoopOrder::state:
      return {{}, loop.state};
    case LoopOrder::window:  // the newest first
      return numbered(loop.slot_end_us, -1.0);
  }
  return {};
}

bool comes_first(const Key& a, const Key& b, bool backwards) {
  if (a.is_none() || b.is_none()) return !a.is_none() && b.is_none();
  const Key& low = backwards ? b : a;
  const Key& high = backwards ? a : b;
  return low.word ? *low.word < *high.word : *low.number < *high.number;
}

bool is(std::string_view wanted, std::string_view value) {
  return wanted.empty() || wanted == value;
}

bool fits(const LoopRow& loop, const LoopQuery& query, const std::string& part) {
  return is(query.area, loop.area.value_or("")) && is(query.unit, loop.unit.value_or("")) &&
         is(query.state, loop.state) && is(query.verdict, shown_verdict(loop)) &&
         (query.part.empty() ||
          (!part.empty() && loop.searched.find(part) != std::string_view::npos));
}

/// The texts that loops have, in the order of their places.
class Choices {
 public:
  void add(std::optional<std::string_view> text, std::optional<std::int64_t> place) {
    if (text && place) values_.emplace(*place, *text);
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const auto& [place, text] : values_) texts.emplace_back(text);
    return texts;
  }

 private:
  std::set<std::pair<std::int64_t, std::string_view>> values_;
};

void add_choices(const storage::ListedLoops& loops, LoopListing& listing) {
  Choices areas, units;
  std::set<std::string_view> verdicts;
  for (const LoopRow loop : loops) {
    areas.add(loop.area, loop.area_place);
    units.add(loop.unit, loop.unit_place);
    if (loop.code) verdicts.insert(shown_verdict(loop));
  }
  listing.areas = areas.texts();
  listing.units = units.texts();
  listing.verdicts.assign(verdicts.begin(), verdicts.end());
  listing.verdicts.emplace_back("none");
}

}  // namespace

const std::vector<std::string>& loop_orders() {
  static const std::vector<std::string> orders{"rank",    "name",       "area",  "unit",
                                               "verdict", "confidence", "state", "window"};
  return orders;
}

const std::vector<std::string>& loop_states() {
  static const std::vector<std::string> states{"flagged", "off the list", "not flagged",
                                               "never analysed", "disabled"};
  return states;
}

std::string_view shown_verdict(const LoopRow& loop) {
  return loop.shown_code ? *loop.shown_code : loop.code.value_or("none");
}

LoopListing choose_loops(const storage::ListedLoops& loops, const LoopQuery& query,
                         const std::string& part) {
  std::vector<std::pair<Key, std::size_t>> fitting;
  for (std::size_t k = 0; k < loops.size(); ++k)
    if (const LoopRow loop = loops[k]; fits(loop, query, part))
      fitting.emplace_back(key_of(loop, query.order), k);
  std::ranges::stable_sort(fitting, [&](const auto& a, const auto& b) {
    return comes_first(a.first, b.first, query.backwards);
  });
  LoopListing listing;
  listing.all = static_cast<std::int64_t>(loops.size());
  listing.fitting = static_cast<std::int64_t>(fitting.size());
  add_choices(loops, listing);
  const std::int64_t last =
      std::max<std::int64_t>(listing.fitting - 1, 0) / query.most * query.most;
  const std::int64_t first = listing.skip = std::min(query.skip, last);
  for (std::int64_t k = first; k < std::min(first + query.most, listing.fitting); ++k)
    listing.loops.push_back(loops[fitting[static_cast<std::size_t>(k)].second]);
  return listing;
}

}  // namespace loopscope::daemon
