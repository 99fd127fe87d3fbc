#include "daemon/report/sections/ranked_list.hpp"

#include <fmt/format.h>

#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::FlaggedRow;

std::string number_cell(const char* label, double value, const std::string& shown) {
  return fmt::format("<td class=\"number\" data-label=\"{}\" data-sort=\"{:.9g}\">{}</td>", label,
                     value, shown);
}

std::string name_cell(const FlaggedRow& row, LoopLinks links) {
  const std::string type = row.loop_type ? "<small>" + html(*row.loop_type) + "</small>" : "";
  const std::string source =
      row.plant_oscillation_number
          ? fmt::format("<small class=\"role\">source of oscillation {}</small>",
                        *row.plant_oscillation_number)
          : "";
  return fmt::format(
      "<td class=\"loop-name\" data-label=\"Loop\"><a href=\"{}\"><bdi>{}</bdi></a>{}{}</td>",
      loop_link(links, row.loop_id, row.loop_name), html(row.loop_name), type, source);
}

std::string ranked_row(const FlaggedRow& row, std::int64_t since_us, LoopLinks links) {
  const bool is_new = row.since_us > since_us;
  std::string text = fmt::format("<tr data-verdict=\"{}\" data-status=\"{}\">",
                                 html(as_heading(row.code)), html(row.status));
  text += number_cell("Rank", static_cast<double>(row.rank), std::to_string(row.rank));
  text += name_cell(row, links);
  text += fmt::format("<td data-label=\"Verdict\"><span class=\"verdict {}\">{}</span></td>",
                      html(row.code), html(as_heading(row.code)));
  text += number_cell("Confidence", row.believed(), two_decimals(row.believed()));
  text += fmt::format("<td data-label=\"Status\"><span class=\"status {0}\">{0}</span></td>",
                      html(row.status));
  text += fmt::format("<td class=\"when\" data-label=\"Since\" data-sort=\"{}\">{}{}</td>",
                      row.since_us, minute(row.since_us),
                      is_new ? " <span class=\"fresh\">new</span>" : "");
  text += number_cell("Severity", row.severity, two_decimals(row.severity));
  text += number_cell("Importance", row.importance, digits(row.importance));
  text += number_cell("Kind", row.kind_weight, two_decimals(row.kind_weight));
  text += number_cell("Score", row.score, fmt::format("<b>{}</b>", digits(row.score)));
  return text +
         fmt::format("<td class=\"action\" data-label=\"Action\">{}</td></tr>\n", html(row.action));
}

}  // namespace

std::string ranked_list(const std::vector<FlaggedRow>& flagged, std::int64_t since_us,
                        LoopLinks links) {
  if (flagged.empty()) return "<h2>Work list</h2>\n<p>No loop is flagged: nothing to act on.</p>\n";
  std::string text =
      "<h2>Work list</h2>\n"
      "<p class=\"note\">Dead measurements first, then by score = severity (1 less the middle of "
      "the Harris index) \u00d7 importance of the loop \u00d7 weight of the kind of fault \u00d7 "
      "confidence. Status: <i>watch</i> until a second window that shares no sample with the first "
      "says the same.</p>\n"
      "<table class=\"ranking sortable filterable\"><thead><tr><th class=\"number\">Rank</th>"
      "<th>Loop</th><th>Verdict</th><th class=\"number\">Confidence</th><th>Status</th>"
      "<th>Since (UTC)</th><th class=\"number\">Severity</th><th class=\"number\">Impor\u00adtance"
      "</th><th class=\"number\">Kind</th><th class=\"number\">Score</th><th>Action</th></tr>"
      "</thead><tbody>\n";
  for (const FlaggedRow& row : flagged) text += ranked_row(row, since_us, links);
  return text + "</tbody></table>\n";
}

}  // namespace loopscope::daemon
