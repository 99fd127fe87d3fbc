#include "daemon/report/plant/ranked_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <string>

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::FlaggedRow;

/// By which the page's script sorts.
std::string sort_key(double value) {
  return fmt::format("{:.9g}", value);
}

/// Area and unit, as far as they are known.
std::string place_of(const FlaggedRow& row) {
  const std::string between = row.area && row.unit ? ", " : "";
  return row.area.value_or("") + between + row.unit.value_or("");
}

Fields ranked_fields(const FlaggedRow& row, std::int64_t since_us, const LoopLinks& links,
                     const TimeZone& zone) {
  return {{"rank", row.rank},
          {"verdict", as_heading(row.code)},
          {"code", row.code},
          {"status_class", row.status},
          {"status", status_words(row.status)},
          {"link", links.to_loop(row.loop_id, row.loop_name)},
          {"name", row.loop_name},
          {"type", row.loop_type.value_or("")},
          {"description", row.description.value_or("")},
          {"place", place_of(row)},
          {"oscillation", number_text(row.plant_oscillation_number)},
          {"confidence_sort", sort_key(row.believed())},
          {"confidence", two_decimals(row.believed())},
          {"since_us", row.since_us},
          {"since", minute_below_zone(row.since_us, zone)},
          {"or_earlier", row.or_earlier},
          {"is_new", row.began_after(since_us)},
          {"score_sort", sort_key(row.score)},
          {"score", digits(row.score)}};
}

std::span<const FlaggedRow> shown_of(std::span<const FlaggedRow> flagged, const LoopLinks& links) {
  return links.is_live() ? flagged.first(std::min(flagged.size(), kMostRanked)) : flagged;
}

}  // namespace

Markup ranked_list(const std::vector<FlaggedRow>& flagged, std::int64_t since_us,
                   const LoopLinks& links, const TimeZone& zone) {
  const auto fields = [&](const FlaggedRow& row) {
    return ranked_fields(row, since_us, links, zone);
  };
  const auto has_place = [](const FlaggedRow& row) { return row.area || row.unit; };
  const std::span<const FlaggedRow> shown = shown_of(flagged, links);
  return render("ranked_list", {{"any_flagged", !flagged.empty()},
                                {"zone", zone.name()},
                                {"whole", shown.size() == flagged.size()},
                                {"shown", static_cast<std::int64_t>(shown.size())},
                                {"all", static_cast<std::int64_t>(flagged.size())},
                                {"all_link", links.to_loops("?state=flagged")},
                                {"any_place", std::ranges::any_of(flagged, has_place)},
                                {"flagged", rows(shown, fields)}});
}

}  // namespace loopscope::daemon
