#include "daemon/report/sections/plant_section.hpp"

#include <fmt/format.h>

#include "core/model/results/phrases.hpp"
#include "daemon/report/sections/event_box.hpp"
#include "daemon/report/sections/ranked_list.hpp"
#include "daemon/report/sections/repairs_table.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

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
  text += tile(counts.flagged, "flagged", "action needed", "act");
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
  std::string name = "<bdi>" + html(loop_name) + "</bdi>";
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

std::string no_pictures(const PlantFacts& facts) {
  if (facts.picture_trouble.empty()) return {};
  return "<p class=\"trouble\">No trends and spectra: " + html(facts.picture_trouble) + "</p>\n";
}

std::string oscillations(const PlantFacts& facts, LoopLinks links) {
  if (facts.oscillations.empty()) return {};
  std::string text = "<h2>Plant-wide oscillations</h2>\n" + no_pictures(facts);
  for (const storage::PlantOscillationRow& event : facts.oscillations)
    text += event_box(event, facts.album.of_event(event.number), facts.flagged, links);
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
