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

std::string service_note(const storage::PlantCounts& counts) {
  return counts.service_factor ? "service factor " + core::model::in_percent(*counts.service_factor)
                               : "no mode or output recorded";
}

std::string tiles(const PlantFacts& facts) {
  const storage::PlantCounts& counts = facts.counts;
  std::string text = "<div class=\"tiles\">\n";
  text += tile(counts.loops, "loops", fmt::format("{} enabled", counts.enabled));
  text += tile(counts.judged, "judged", "newest window could be judged");
  text += tile(counts.not_controlling, "not in control", service_note(counts));
  text += tile(counts.flagged, "flagged", "somebody should act", "act");
  text += tile(counts.new_flags, "new", "since " + utc(facts.since_us), "act");
  text += tile(counts.fixed, "fixed", "repairs since then", "good");
  text += tile(counts.unjudgeable, "unjudgeable", why_unjudged(counts));
  return text + "</div>\n";
}

std::string hidden_note(const storage::PlantCounts& counts) {
  if (counts.victims + counts.annotated + counts.unlisted == 0) return {};
  return fmt::format(
      "<p class=\"note\">Not in the list: {} of a shared oscillation, {} that people have "
      "acknowledged, suppressed or marked as false, {} not sure enough (view hidden_loop).</p>\n",
      counted(counts.victims, "victim", "victims"),
      counted(counts.annotated, "finding", "findings"),
      counted(counts.unlisted, "fault", "faults"));
}

std::string name_of(std::int64_t loop_id, const std::string& loop_name, LoopLinks links) {
  const std::string name = "<bdi>" + html(loop_name) + "</bdi>";
  // Only a live page has one for every loop.
  if (links == LoopLinks::sections) return name;
  return fmt::format("<a href=\"{}\">{}</a>", loop_link(links, loop_id, loop_name), name);
}

std::string names_of(const storage::UnjudgedReason& reason, LoopLinks links) {
  std::string text;
  for (const std::string& name : reason.names)
    text += (text.empty() ? "" : ", ") + name_of(0, name, links);
  const auto shown = static_cast<std::int64_t>(reason.names.size());
  return reason.loops > shown ? text + fmt::format(" and {} more", reason.loops - shown) : text;
}

std::string unjudged(const storage::PlantCounts& counts, LoopLinks links) {
  if (counts.reasons.empty()) return {};
  std::string text =
      "<h2>Loops that cannot be judged</h2>\n<table class=\"unjudged\"><thead><tr>"
      "<th class=\"number\">Loops</th><th>Reason</th><th>Which</th><th>What to do</th></tr>"
      "</thead><tbody>\n";
  for (const storage::UnjudgedReason& reason : counts.reasons)
    text += fmt::format(
        "<tr><td class=\"number\" data-label=\"Loops\">{}</td><td data-label=\"Reason\">{}</td>"
        "<td data-label=\"Which\">{}</td><td data-label=\"What to do\">{}</td></tr>\n",
        reason.loops, html(reason.words), names_of(reason, links), html(reason.remedy));
  return text + "</tbody></table>\n";
}

std::string lost_words(const storage::NotControllingRow& row) {
  return row.lost_by == "mode" ? "manual, tracking or out of service" : "constant output";
}

/// What plants look at first: whether the controllers are in service at all.
std::string without_controller(const storage::PlantCounts& counts, LoopLinks links) {
  if (counts.without_controller.empty()) return {};
  std::string text =
      "<h2>Loops without a controller</h2>\n<table class=\"unjudged\"><thead><tr><th>Loop</th>"
      "<th>Area</th><th>State</th><th>Since</th><th class=\"number\">In service, last 7 days</th>"
      "</tr></thead><tbody>\n";
  for (const storage::NotControllingRow& row : counts.without_controller)
    text += fmt::format(
        "<tr><td data-label=\"Loop\">{}</td><td data-label=\"Area\">{}</td>"
        "<td data-label=\"State\">{}</td><td class=\"when\" data-label=\"Since\">{}</td>"
        "<td class=\"number\" data-label=\"In service, last 7 days\">{}</td></tr>\n",
        name_of(row.loop_id, row.loop_name, links), html(row.area.value_or("")), lost_words(row),
        row.since_us ? utc(*row.since_us) : "",
        row.week_fraction ? core::model::in_percent(*row.week_fraction) : "");
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
  return text + without_controller(facts.counts, links) + unjudged(facts.counts, links) +
         "</section>\n";
}

}  // namespace loopscope::daemon
