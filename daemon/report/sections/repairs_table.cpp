#include "daemon/report/sections/repairs_table.hpp"

#include <fmt/format.h>
#include <iterator>

#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::RepairRow;

/// The change with its interval; nothing where one side has no such figure.
std::string change_of(const storage::RepairFigure& figure) {
  if (!figure.change) return {};
  return fmt::format(" ({} {}, {} to {})", figure.is_ratio ? "\u00d7" : "by", digits(figure.change),
                     digits(figure.change_low), digits(figure.change_high));
}

std::string figure_rows(const RepairRow& repair) {
  std::string text;
  for (const storage::RepairFigure& figure : repair.figures) {
    if (!figure.before && !figure.after) continue;
    const std::string unit = figure.unit.empty() ? "" : " " + html(figure.unit);
    fmt::format_to(std::back_inserter(text), "{}<span class=\"pair\">{} {} \u2192 {}{}{}</span>",
                   text.empty() ? "" : " ", html(in_words(figure.name)), digits(figure.before),
                   digits(figure.after), unit, change_of(figure));
  }
  return text;
}

std::string repair_row(const RepairRow& repair) {
  const std::string word =
      repair.word.value_or(repair.windows_before == 0 ? "not judged" : "too early");
  return fmt::format(
      "<tr><td data-label=\"Loop\"><bdi>{}</bdi></td><td class=\"when\" data-label=\"Done\" "
      "data-sort=\"{}\">{}</td><td data-label=\"Work\">{}: <bdi>{}</bdi></td><td "
      "data-label=\"Result\"><span class=\"word {}\">{}</span></td><td data-label=\"Why\">{} "
      "<small>{}</small></td></tr>\n",
      html(repair.loop_name), repair.done_at_us, utc(repair.done_at_us), html(repair.kind),
      html(repair.description), html(repair.word.value_or("unknown")), html(word),
      html(repair.statement), figure_rows(repair));
}

}  // namespace

std::string repairs_table(const std::vector<RepairRow>& repairs) {
  std::string text =
      "<table class=\"repairs\"><thead><tr><th>Loop</th><th>Done</th><th>Work</th><th>Result</th>"
      "<th>Why</th></tr></thead><tbody>\n";
  for (const RepairRow& repair : repairs) text += repair_row(repair);
  return text +
         "</tbody></table>\n<p class=\"note\">In brackets the change with its 90 % interval, which "
         "holds the ordinary change of a loop that nobody touched.</p>\n";
}

}  // namespace loopscope::daemon
