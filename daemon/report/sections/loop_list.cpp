#include "daemon/report/sections/loop_list.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoopRow;

/// A browser lays out no more with ease; loopscope.latest_verdict has all.
constexpr std::size_t kMostRows = 5000;

constexpr const char* kDash = "\u2013";

std::string status_of(const LoopRow& row) {
  if (row.status) return *row.status;
  if (row.hidden_by) return "not on the list: " + *row.hidden_by;
  return row.code ? "not flagged" : "never analysed";
}

/// A loop that is healthy by itself and shaken by others is not shown as healthy.
std::string code_shown(const LoopRow& row) {
  return row.shown_code ? *row.shown_code : row.code.value_or("");
}

std::string verdict_cell(const LoopRow& row) {
  if (!row.code) return std::string("<td data-label=\"Verdict\">") + kDash + "</td>";
  const std::string code = code_shown(row);
  return fmt::format("<td data-label=\"Verdict\"><span class=\"verdict {}\">{}</span>{}</td>",
                     html(code), html(as_heading(code)),
                     code == *row.code ? "" : "<small>by itself " + html(*row.code) + "</small>");
}

/// With whose oscillation it follows, on the work list or not.
std::string status_cell(const LoopRow& row) {
  return fmt::format("<td data-label=\"Status\">{}{}</td>", html(status_of(row)),
                     row.follows ? "<small>" + html(*row.follows) + "</small>" : "");
}

/// A loop that was never analysed has no page.
std::string name_of(const LoopRow& row) {
  std::string name = "<bdi>" + html(row.name) + "</bdi>";
  if (!row.code) return name;
  return fmt::format("<a href=\"{}\">{}</a>", loop_link(LoopLinks::pages, row.loop_id, row.name),
                     name);
}

std::string loop_row(const LoopRow& row) {
  return fmt::format(
             "<tr data-verdict=\"{}\" data-status=\"{}\"><td class=\"loop-name\" "
             "data-label=\"Loop\">{}</td><td data-label=\"Type\">{}"
             "</td><td data-label=\"Source\"><bdi>{}</bdi></td>",
             html(as_heading(code_shown(row))), html(status_of(row)), name_of(row),
             html(row.loop_type.value_or(kDash)), html(row.source)) +
         verdict_cell(row) +
         fmt::format(
             "<td class=\"number\" data-label=\"Confidence\" data-sort=\"{:.6g}\">{}</td>"
             "{}<td data-label=\"Rank\" class=\"number\" "
             "data-sort=\"{}\">{}</td><td class=\"when\" data-label=\"Window\">{}</td>"
             "<td data-label=\"Monitor\">{}</td></tr>\n",
             row.confidence.value_or(-1.0), row.confidence ? two_decimals(*row.confidence) : kDash,
             status_cell(row), row.rank.value_or(1'000'000'000),
             row.rank ? std::to_string(*row.rank) : kDash,
             row.slot_end_us ? utc(*row.slot_end_us) : kDash, html(in_words(row.health)));
}

}  // namespace

std::string loop_list(const std::vector<LoopRow>& rows) {
  std::string text =
      "<table class=\"loops sortable filterable\"><thead><tr><th>Loop</th><th>Type</th>"
      "<th>Source</th><th>Verdict</th><th class=\"number\">Confidence</th><th>Status</th>"
      "<th class=\"number\">Rank</th><th>Window until</th><th>Monitor</th></tr></thead><tbody>\n";
  for (std::size_t k = 0; k < std::min(rows.size(), kMostRows); ++k) text += loop_row(rows[k]);
  text += "</tbody></table>\n";
  if (rows.size() > kMostRows)
    text += fmt::format(
        "<p class=\"note\">The first {} of {} loops, flagged ones before others; all of them: "
        "SELECT * FROM "
        "loopscope.latest_verdict.</p>\n",
        kMostRows, rows.size());
  return text;
}

}  // namespace loopscope::daemon
