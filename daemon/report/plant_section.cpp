#include "daemon/report/plant_section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "core/model/phrases.hpp"
#include "daemon/report/html_text.hpp"
#include "daemon/report/page_text.hpp"
#include "daemon/report/ranked_list.hpp"
#include "daemon/report/repairs_table.hpp"
#include "daemon/report/verdict_words.hpp"

namespace loopscope::daemon {
namespace {

using storage::PlantOscillationRow;

std::string tile(std::int64_t number, const std::string& words, const std::string& note = "",
                 const char* kind = "") {
  return fmt::format("<div class=\"tile {}\"><b>{}</b><span>{}</span><small>{}</small></div>\n",
                     kind, number, html(words), html(note));
}

/// The most frequent reason; the table below has all.
std::string why_unjudged(const storage::PlantCounts& counts) {
  std::string text = counts.reasons.empty()
                         ? ""
                         : fmt::format("{} \u00d7 {}; ", counts.reasons.front().loops,
                                       counts.reasons.front().words);
  return text + fmt::format("{} never analysed", counts.never_analysed);
}

std::string tiles(const PlantFacts& facts) {
  const storage::PlantCounts& counts = facts.counts;
  std::string text = "<div class=\"tiles\">\n";
  text += tile(counts.loops, "loops", fmt::format("{} enabled", counts.enabled));
  text += tile(counts.judged, "judged", "newest window could be judged");
  text += tile(counts.flagged, "flagged", "somebody should act", "act");
  text += tile(counts.new_flags, "new", "since " + utc(facts.since_us), "act");
  text += tile(counts.fixed, "fixed", "repairs since then", "good");
  text += tile(counts.unjudgeable, "unjudgeable", why_unjudged(counts));
  return text + "</div>\n";
}

std::string hidden_note(const storage::PlantCounts& counts) {
  if (counts.victims + counts.annotated == 0) return {};
  return fmt::format(
      "<p class=\"note\">Not in the list: {} of a shared oscillation, {} that people have "
      "acknowledged, suppressed or marked as false.</p>\n",
      counted(counts.victims, "victim", "victims"),
      counted(counts.annotated, "finding", "findings"));
}

std::string unjudged(const storage::PlantCounts& counts) {
  if (counts.reasons.empty()) return {};
  std::string text =
      "<h2>Loops that cannot be judged</h2>\n<table class=\"unjudged\"><thead><tr>"
      "<th class=\"number\">Loops</th><th>Reason</th><th>What mends it</th></tr></thead><tbody>\n";
  for (const storage::UnjudgedReason& reason : counts.reasons)
    text += fmt::format(
        "<tr><td class=\"number\" data-label=\"Loops\">{}</td><td data-label=\"Reason\">{}</td>"
        "<td data-label=\"What mends it\">{}</td></tr>\n",
        reason.loops, html(reason.words), html(reason.remedy));
  return text + "</tbody></table>\n";
}

/// A victim has no section of its own: it is not in the work list.
std::string linked_name(const PlantOscillationRow::Member& member, const PlantFacts& facts,
                        LoopLinks links) {
  std::string name = "<bdi>" + html(member.loop_name) + "</bdi>";
  const bool flagged = std::ranges::find(facts.flagged, member.loop_id,
                                         &storage::FlaggedRow::loop_id) != facts.flagged.end();
  if (links == LoopLinks::sections && !flagged) return name;
  return fmt::format("<a href=\"{}\">{}</a>", loop_link(links, member.loop_id, member.loop_name),
                     name);
}

/// Lags are within half a period of the source's swing, before or after it.
std::string lag_words(const PlantOscillationRow::Member& member, const PlantOscillationRow& event) {
  if (!event.source_name || member.role == "source") return {};
  return ", " + core::model::in_time(std::abs(member.lag_s)) +
         (member.lag_s < 0.0 ? " ahead" : " behind");
}

std::string members(const PlantOscillationRow& event, const PlantFacts& facts, LoopLinks links) {
  std::string text;
  for (const PlantOscillationRow::Member& member : event.members) {
    text += fmt::format("<li>{} <span class=\"role\">{}</span> {} of the error{}</li>\n",
                        linked_name(member, facts, links), html(in_words(member.role)),
                        core::model::in_percent(member.strength), lag_words(member, event));
  }
  return "<ul class=\"members\">\n" + text + "</ul>\n";
}

std::string oscillation(const PlantOscillationRow& event, const PlantFacts& facts,
                        LoopLinks links) {
  const std::string source = event.source_name
                                 ? "<b><bdi>" + html(*event.source_name) + "</bdi></b>"
                                 : std::string("unknown, or outside of the loops");
  return fmt::format(
             "<article class=\"event\"><h3>Plant-wide oscillation {}: period {}, {}</h3>\n"
             "<p>Source: {}. {}</p>\n<p class=\"note\">Found in windows until {}.</p>\n",
             event.number, core::model::in_time(event.period_s),
             counted(static_cast<std::int64_t>(event.members.size()), "loop", "loops"), source,
             html(event.statement), utc(event.slot_end_us)) +
         members(event, facts, links) + "</article>\n";
}

std::string oscillations(const PlantFacts& facts, LoopLinks links) {
  if (facts.oscillations.empty()) return {};
  std::string text = "<h2>Oscillations that loops share</h2>\n";
  for (const PlantOscillationRow& event : facts.oscillations)
    text += oscillation(event, facts, links);
  return text;
}

}  // namespace

std::string plant_section(const PlantFacts& facts, LoopLinks links) {
  std::string text = "<section id=\"plant\">\n" + tiles(facts) + hidden_note(facts.counts) +
                     oscillations(facts, links) + ranked_list(facts.flagged, facts.since_us, links);
  if (!facts.repairs.empty())
    text += "<h2>Repairs, before and after</h2>\n" + repairs_table(facts.repairs);
  return text + unjudged(facts.counts) + "</section>\n";
}

}  // namespace loopscope::daemon
