#include "daemon/report/sections/ranked_list.hpp"

#include <fmt/format.h>

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::FlaggedRow;

/// By which the page's script sorts.
std::string sort_key(double value) {
  return fmt::format("{:.9g}", value);
}

Fields ranked_fields(const FlaggedRow& row, std::int64_t since_us, LoopLinks links,
                     const TimeZone& zone) {
  return {{"rank", row.rank},
          {"verdict", as_heading(row.code)},
          {"code", row.code},
          {"status_class", row.status},
          {"status", status_words(row.status)},
          {"link", loop_link(links, row.loop_id, row.loop_name)},
          {"name", row.loop_name},
          {"type", row.loop_type.value_or("")},
          {"oscillation", number_text(row.plant_oscillation_number)},
          {"confidence_sort", sort_key(row.believed())},
          {"confidence", two_decimals(row.believed())},
          {"since_us", row.since_us},
          {"since", minute_below_zone(row.since_us, zone)},
          {"or_earlier", row.or_earlier},
          {"is_new", row.since_us > since_us && !row.or_earlier},
          {"score_sort", sort_key(row.score)},
          {"score", digits(row.score)},
          {"action", row.action}};
}

}  // namespace

Markup ranked_list(const std::vector<FlaggedRow>& flagged, std::int64_t since_us, LoopLinks links,
                   const TimeZone& zone) {
  const auto fields = [&](const FlaggedRow& row) {
    return ranked_fields(row, since_us, links, zone);
  };
  return render("ranked_list", {{"any_flagged", !flagged.empty()},
                                {"zone", zone.name()},
                                {"flagged", rows(flagged, fields)}});
}

}  // namespace loopscope::daemon
