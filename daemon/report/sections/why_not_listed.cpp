#include "daemon/report/sections/why_not_listed.hpp"

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::HiddenRow;

Fields by_an_oscillation(const HiddenRow& row) {
  return {{"oscillation", *row.plant_oscillation_number},
          {"source", row.source_name.value_or("")},
          {"by_the_list", false},
          {"entered", false}};
}

/// The list itself asks for more.
Fields by_the_list(const HiddenRow& row) {
  return {{"oscillation", false},
          {"by_the_list", true},
          {"why", as_heading(row.reason)},
          {"entered", false}};
}

bool is_by_the_list(const HiddenRow& row) {
  return row.hidden_by == "probability" || row.hidden_by == "chance";
}

/// As the view annotation_history ends it; empty = when it is withdrawn.
std::string until(const HiddenRow& row, const TimeZone& zone) {
  if (row.until_us) return minute_in_zone(*row.until_us, zone);
  return row.hidden_by == "acknowledged"
             ? "work done since is entered and a window lies wholly after it"
             : "";
}

Fields by_somebody(const HiddenRow& row, const TimeZone& zone) {
  return {{"oscillation", false},
          {"by_the_list", false},
          {"deed", deed_words(row.hidden_by)},
          {"author", author_text(row.author, row.on_behalf_of)},
          {"entered", minute_in_zone(row.entered_us, zone)},
          {"until", until(row, zone)},
          {"reason", row.reason}};
}

Fields hidden_fields(const HiddenRow& row, const TimeZone& zone) {
  if (row.plant_oscillation_number) return by_an_oscillation(row);
  return is_by_the_list(row) ? by_the_list(row) : by_somebody(row, zone);
}

}  // namespace

Markup why_not_listed(const std::vector<HiddenRow>& hidden, const TimeZone& zone,
                      const std::string& annotate_address) {
  if (hidden.empty()) return {};
  const auto fields = [&](const HiddenRow& row) { return hidden_fields(row, zone); };
  return render("why_not_listed",
                {{"hidden", rows(hidden, fields)}, {"annotate", annotate_address}});
}

}  // namespace loopscope::daemon
