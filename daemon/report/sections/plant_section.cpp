#include "daemon/report/sections/plant_section.hpp"

#include <fmt/format.h>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/annotated_table.hpp"
#include "daemon/report/sections/event_box.hpp"
#include "daemon/report/sections/ranked_list.hpp"
#include "daemon/report/sections/repairs_table.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

Fields tile(std::int64_t number, const char* words, const std::string& note = "",
            const char* kind = "") {
  return {{"number", number}, {"words", words}, {"note", note}, {"kind", kind}};
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
  return counts.service_factor ? "service factor " + core::text::percent(*counts.service_factor)
                               : "no mode or output recorded";
}

List tiles(const PlantFacts& facts) {
  const storage::PlantCounts& counts = facts.counts;
  return {
      tile(counts.loops, counts.loops == 1 ? "loop" : "loops",
           fmt::format("{} enabled", counts.enabled)),
      tile(counts.judged, "judged", "newest window could be judged"),
      tile(counts.not_controlling, "not in control", service_note(counts)),
      tile(counts.flagged, "flagged", "action needed", "act"),
      tile(counts.new_flags, "new", "since " + minute_in_zone(facts.since_us, facts.zone), "act"),
      tile(counts.fixed, "fixed", "repairs since then", "good"),
      tile(counts.unjudgeable, "unjudgeable", why_unjudged(counts))};
}

/// Only a live page has a page for every loop.
std::string live_link(std::int64_t loop_id, const std::string& loop_name, LoopLinks links) {
  return links == LoopLinks::pages ? loop_link(links, loop_id, loop_name) : "";
}

List named(const storage::UnjudgedReason& reason, LoopLinks links) {
  List names;
  for (const std::string& name : reason.names)
    names.emplace_back(Fields{{"between", names.empty() ? "" : ", "},
                              {"link", live_link(0, name, links)},
                              {"name", name}});
  return names;
}

Fields unjudged_fields(const storage::UnjudgedReason& reason, LoopLinks links,
                       const TimeZone& zone) {
  const auto more = reason.loops - static_cast<std::int64_t>(reason.names.size());
  return {{"loops", reason.loops},
          {"reason", reason.words},
          {"named", named(reason, links)},
          {"more", more > 0 ? fmt::format(" and {} more", more) : ""},
          {"remedy", with_times_in_zone(reason.remedy, zone)}};
}

std::string lost_words(const storage::NotControllingRow& row) {
  return row.lost_by == "mode" ? "manual, tracking or out of service" : "constant output";
}

Fields open_loop_fields(const storage::NotControllingRow& row, LoopLinks links,
                        const TimeZone& zone) {
  return {{"link", live_link(row.loop_id, row.loop_name, links)},
          {"name", row.loop_name},
          {"area", row.area.value_or("")},
          {"state", lost_words(row)},
          {"since", row.since_us ? minute_in_zone(*row.since_us, zone) : ""},
          {"in_service", row.week_fraction ? core::text::percent(*row.week_fraction) : ""}};
}

std::vector<Markup> event_boxes(const PlantFacts& facts, LoopLinks links) {
  std::vector<Markup> boxes;
  for (const storage::PlantOscillationRow& event : facts.oscillations)
    boxes.push_back(
        event_box(event, facts.album.of_event(event.number), facts.flagged, links, facts.zone));
  return boxes;
}

}  // namespace

Markup plant_section(const PlantFacts& facts, LoopLinks links) {
  const storage::PlantCounts& counts = facts.counts;
  const TimeZone& zone = facts.zone;
  const auto open_loop = [&](const auto& row) { return open_loop_fields(row, links, zone); };
  const auto unjudged = [&](const auto& reason) { return unjudged_fields(reason, links, zone); };
  return render("plant_section",
                {{"tiles", tiles(facts)},
                 {"any_hidden", counts.victims + counts.annotated + counts.unlisted != 0},
                 {"affected", core::text::counted(counts.victims, "loop", "loops")},
                 {"findings", core::text::counted(counts.annotated, "finding", "findings")},
                 {"faults", core::text::counted(counts.unlisted, "fault", "faults")},
                 {"any_oscillation", !facts.oscillations.empty()},
                 {"picture_trouble", facts.picture_trouble},
                 {"oscillations", event_boxes(facts, links)},
                 {"work_list", ranked_list(facts.flagged, facts.since_us, links, zone)},
                 {"annotated", annotated_table(counts, links, zone)},
                 {"repairs", repairs_table(facts.repairs, zone)},
                 // What plants look at first: whether the controllers are in service at all.
                 {"any_without_controller", !counts.without_controller.empty()},
                 {"without_controller", rows(counts.without_controller, open_loop)},
                 {"any_unjudged", !counts.reasons.empty()},
                 {"unjudged", rows(counts.reasons, unjudged)}});
}

}  // namespace loopscope::daemon
