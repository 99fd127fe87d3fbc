#include "daemon/report/plant/plant_section.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/plant/annotated_table.hpp"
#include "daemon/report/plant/area_table.hpp"
#include "daemon/report/plant/event_box.hpp"
#include "daemon/report/plant/event_list.hpp"
#include "daemon/report/plant/idle_loops.hpp"
#include "daemon/report/plant/kind_table.hpp"
#include "daemon/report/plant/ranked_list.hpp"
#include "daemon/report/sections/repairs_table.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

/// A page with more repairs is not read to its end.
constexpr std::size_t kMostRepairs = 25;

Fields tile(std::int64_t number, const char* words, const std::string& note = "",
            const char* kind = "") {
  return {{"number", number}, {"words", words}, {"note", note}, {"kind", kind}};
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
      tile(counts.unjudgeable, "unjudgeable",
           fmt::format("why: below; {} never analysed", counts.never_analysed))};
}

std::vector<storage::RepairRow> newest_repairs(const std::vector<storage::RepairRow>& repairs) {
  const auto shown = static_cast<std::ptrdiff_t>(std::min(repairs.size(), kMostRepairs));
  return {repairs.begin(), repairs.begin() + shown};
}

std::string more_repairs(const std::vector<storage::RepairRow>& repairs) {
  if (repairs.size() <= kMostRepairs) return {};
  const auto more = static_cast<std::int64_t>(repairs.size() - kMostRepairs);
  return core::text::counted(more, "repair", "repairs");
}

/// A page of the daemon has one for each; a report has them here, folded.
Markup events(const PlantFacts& facts, const LoopLinks& links) {
  if (links.is_live()) return event_list(facts.oscillations);
  return event_boxes(facts.oscillations, facts.album, facts.picture_trouble, links, facts.zone);
}

/// In a report an area leads to its sections, which are there where it has a flagged loop.
Markup areas(const PlantFacts& facts, const LoopLinks& links) {
  const std::vector<AreaCounts> areas = count_areas(facts.loops);
  return area_table(areas, [&](const AreaCounts& one) -> std::string {
    if (!links.is_live()) return one.flagged > 0 ? area_anchor("#", one.best_rank) : "";
    return one.area.empty() ? "" : links.to_loops("?area=" + url_value(one.area));
  });
}

}  // namespace

std::string area_anchor(const std::string& before, std::int64_t best_rank) {
  return fmt::format("{}area-{}", before, best_rank);
}

Markup plant_section(const PlantFacts& facts, const LoopLinks& links) {
  const storage::PlantCounts& counts = facts.counts;
  const TimeZone& zone = facts.zone;
  return render("plant_section",
                {{"tiles", tiles(facts)},
                 {"work_list", ranked_list(facts.flagged, facts.since_us, links, zone)},
                 {"any_hidden", counts.victims + counts.annotated + counts.unlisted != 0},
                 {"affected", core::text::counted(counts.victims, "loop", "loops")},
                 {"findings", core::text::counted(counts.annotated, "finding", "findings")},
                 {"faults", core::text::counted(counts.unlisted, "fault", "faults")},
                 {"off_link", links.to_loops("?state=off%20the%20list")},
                 {"kinds", kind_table(facts.flagged, facts.since_us, links)},
                 {"areas", areas(facts, links)},
                 {"any_event", !facts.oscillations.empty()},
                 {"events", events(facts, links)},
                 {"annotated", annotated_table(counts, links, zone)},
                 {"repairs", repairs_table(newest_repairs(facts.repairs), zone)},
                 {"more_repairs", more_repairs(facts.repairs)},
                 {"idle", idle_loops(counts, links, zone)}});
}

}  // namespace loopscope::daemon
