#include "daemon/report/sections/event_box.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <string_view>
#include <vector>

#include "core/model/results/phrases.hpp"
#include "daemon/report/figures/compact_svg.hpp"
#include "daemon/report/sections/follow_map.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::PlantOscillationRow;
using Member = PlantOscillationRow::Member;

/// Candidates for the source that are told of; less likely ones tell nothing.
constexpr std::size_t kMostCandidates = 4;
constexpr double kLeastOdds = 0.03;
/// Rows of the table; the others are named below it.
constexpr std::size_t kMostRowsOfBox = 16;
/// Statements begin so that speak against a loop (core/plant/source_evidence).
constexpr std::string_view kAgainst = "Against it: ";

/// A victim has no section of its own in a report: it is not in the work list.
std::string linked(const Member& member, std::span<const storage::FlaggedRow> flagged,
                   LoopLinks links) {
  std::string name = "<bdi>" + html(member.loop_name) + "</bdi>";
  const bool listed =
      std::ranges::find(flagged, member.loop_id, &storage::FlaggedRow::loop_id) != flagged.end();
  if (links == LoopLinks::sections && !listed) return name;
  return fmt::format("<a href=\"{}\">{}</a>", loop_link(links, member.loop_id, member.loop_name),
                     name);
}

/// The colour stands in the drawing: WeasyPrint 57 gives those in a page no style of the page.
std::string odds_bar(double probability, std::string_view colour) {
  return fmt::format(
      "<svg class=\"bar\" viewBox=\"0 0 100 8\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><rect fill=\"{}\" width=\"{}\" height=\"8\"/></svg><span "
      "class=\"share\">{}</span>",
      colour, std::lround(100.0 * probability), core::model::in_percent(probability));
}

std::string reasons_list(const char* title, const std::vector<std::string>& reasons) {
  if (reasons.empty()) return {};
  std::string text = fmt::format("<p>{}</p><ul>", title);
  for (const std::string& reason : reasons) text += "<li>" + html(as_heading(reason)) + "</li>";
  return text + "</ul>";
}

std::string for_and_against(const Member& member) {
  std::vector<std::string> in_favour, against;
  for (const std::string& reason : member.reasons) {
    if (reason.starts_with(kAgainst))
      against.push_back(reason.substr(kAgainst.size()));
    else
      in_favour.push_back(reason);
  }
  return reasons_list("For", in_favour) + reasons_list("Against", against);
}

/// What speaks for the first one is open to see.
std::string candidate(const Member& member, bool open) {
  return fmt::format(
      "<details class=\"cause\"{}><summary><span class=\"label\"><bdi>{}</bdi></span>{}</summary>"
      "{}</details>\n",
      open ? " open" : "", html(member.loop_name), odds_bar(*member.score, "#b34700"),
      for_and_against(member));
}

std::string outside_row(double probability) {
  return fmt::format(
      "<details class=\"cause outside\"><summary><span class=\"label\">outside the recorded "
      "loops</span>{}</summary><p>A common supply, a neighbouring unit, a loop that is not "
      "recorded, or the members together.</p></details>\n",
      odds_bar(probability, "#57606a"));
}

std::vector<const Member*> likeliest(const PlantOscillationRow& event) {
  std::vector<const Member*> members;
  for (const Member& member : event.members)
    if (member.score) members.push_back(&member);
  std::ranges::stable_sort(members, std::ranges::greater(),
                           [](const Member* member) { return *member->score; });
  if (members.size() > kMostCandidates) members.resize(kMostCandidates);
  while (members.size() > 1 && *members.back()->score < kLeastOdds) members.pop_back();
  return members;
}

/// Scores of a program that did not weigh the outside are no probabilities.
std::string odds(const PlantOscillationRow& event) {
  if (!event.outside) return {};
  std::string text;
  bool outside_told = false;
  const std::vector<const Member*> members = likeliest(event);
  for (const Member* member : members) {
    if (!outside_told && *event.outside > *member->score) {
      text += outside_row(*event.outside);
      outside_told = true;
    }
    text += candidate(*member, member == members.front());
  }
  if (!outside_told) text += outside_row(*event.outside);
  return "<div class=\"odds\"><h4>Where it comes from, probability</h4>\n" + text + "</div>\n";
}

std::string member_row(const Member& member, std::size_t number, const PlantOscillationRow& event,
                       const std::string& name) {
  const std::string lag = lag_words(member, event);
  return fmt::format(
      "<tr><td class=\"number\" data-label=\"No.\">{}</td><td class=\"loop-name\" "
      "data-label=\"Loop\">{}</td><td data-label=\"Role\"><span class=\"role\">{}</span></td>"
      "<td class=\"number\" data-label=\"Share\">{}</td><td class=\"number\" "
      "data-label=\"Lag\">{}</td><td class=\"number\" data-label=\"Source?\">{}</td></tr>\n",
      number, name, html(in_words(member.role)), core::model::in_percent(member.strength),
      lag.empty() ? "\u2013" : lag,
      event.outside && member.score ? core::model::in_percent(*member.score) : "\u2013");
}

std::string the_rest(const PlantOscillationRow& event, std::span<const storage::FlaggedRow> flagged,
                     LoopLinks links) {
  if (event.members.size() <= kMostRowsOfBox) return {};
  const auto members = std::span<const Member>(event.members).subspan(kMostRowsOfBox);
  std::string text =
      fmt::format("<details><summary>{} with a smaller share</summary><ul class=\"members\">\n",
                  counted(static_cast<std::int64_t>(members.size()), "loop", "loops"));
  for (const Member& member : members)
    text += fmt::format("<li>{} <span class=\"role\">{}</span> {} of the error</li>\n",
                        linked(member, flagged, links), html(in_words(member.role)),
                        core::model::in_percent(member.strength));
  return text + "</ul></details>\n";
}

std::string member_table(const PlantOscillationRow& event,
                         std::span<const storage::FlaggedRow> flagged, LoopLinks links) {
  std::string text =
      "<table class=\"sharing\"><thead><tr><th class=\"number\">No.</th><th>Loop</th><th>Role</th>"
      "<th class=\"number\">Share of its error</th><th class=\"number\">Lag</th>"
      "<th class=\"number\">Probable source</th></tr></thead><tbody>\n";
  const std::span<const Member> members(event.members);
  const std::size_t shown = std::min(kMostRowsOfBox, members.size());
  for (std::size_t k = 0; k < shown; ++k)
    text += member_row(members[k], k + 1, event, linked(members[k], flagged, links));
  return text + "</tbody></table>\n";
}

/// The list stands beside the map: its numbers are those of the pictures.
std::string drawn(const PlantOscillationRow& event, std::span<const Picture> pictures,
                  const std::string& list) {
  std::string text;
  for (const Picture& picture : pictures) text += picture_html(picture);
  text += follow_map(event);
  if (text.empty()) return list;
  return "<div class=\"pictures\">\n" + text + "<div class=\"who\">\n" + list + "</div></div>\n";
}

std::string source_line(const PlantOscillationRow& event) {
  if (!event.source_name) return "unknown, or outside of the loops";
  return "<b><bdi>" + html(*event.source_name) + "</bdi></b>";
}

}  // namespace

std::string event_box(const PlantOscillationRow& event, std::span<const Picture> pictures,
                      std::span<const storage::FlaggedRow> flagged, LoopLinks links) {
  return fmt::format(
             "<article class=\"event\" id=\"oscillation-{0}\"><h3>Plant-wide oscillation {0}: "
             "period {1}, {2}</h3>\n<p>Source: {3}. {4}</p>\n<p class=\"note\">Found in windows "
             "until {5}.</p>\n",
             event.number, core::model::in_time(event.period_s),
             counted(static_cast<std::int64_t>(event.members.size()), "loop", "loops"),
             source_line(event), html(event.statement), utc(event.slot_end_us)) +
         odds(event) + drawn(event, pictures, member_table(event, flagged, links)) +
         the_rest(event, flagged, links) + "</article>\n";
}

}  // namespace loopscope::daemon
