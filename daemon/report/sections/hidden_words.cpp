#include "daemon/report/sections/hidden_words.hpp"

#include <fmt/format.h>

#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::HiddenRow;

std::string by_an_oscillation(const HiddenRow& row) {
  const std::string number =
      fmt::format("plant-wide oscillation {}", *row.plant_oscillation_number);
  if (!row.source_name) return "A victim of " + number + ", whose source is not known.";
  const std::string source = "<bdi>" + html(*row.source_name) + "</bdi>";
  return fmt::format("A victim of {}: repair its source {} first, then check again.", number,
                     source);
}

/// The list itself asks for more.
std::string by_the_list(const HiddenRow& row) {
  return as_heading(row.reason) + ".";
}

bool is_by_the_list(const HiddenRow& row) {
  return row.hidden_by == "probability" || row.hidden_by == "chance";
}

std::string by_somebody(const HiddenRow& row) {
  std::string text = fmt::format("{} by <bdi>{}</bdi>, {}", as_heading(row.hidden_by),
                                 html(row.author), utc(row.entered_us));
  if (row.until_us) text += ", until " + utc(*row.until_us);
  return text + (row.reason.empty() ? "." : ": <bdi>" + html(row.reason) + "</bdi>");
}

}  // namespace

std::string hidden_words(const std::vector<HiddenRow>& hidden) {
  std::string text;
  for (const HiddenRow& row : hidden)
    text += "<dt>Not on the list</dt><dd>" +
            (row.plant_oscillation_number ? by_an_oscillation(row)
             : is_by_the_list(row)        ? by_the_list(row)
                                          : by_somebody(row)) +
            "</dd>\n";
  return text;
}

}  // namespace loopscope::daemon
