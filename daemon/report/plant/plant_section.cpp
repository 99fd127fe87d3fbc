#include "daemon/report/plant/plant_section.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

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
           fmt::format("{}{} never analysed", counts.unjudgeable > 0 ? "why: below; " : "",
                       counts.never_analysed))};
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
std::string area_address(const AreaCounts& one, const LoopLinks& links) {
  if (!links.is_live()) return one.flagged > 0 ? "#" + area_anchor(one.best_rank) : "";
  return one.area.empty() ? "" : links.to_loops("?area=" + url_value(one.area));
}

Fields entry(const std::string& anchor, const std::string& words, std::int64_t number) {
  return {
      {"anchor", anchor}, {"words", words}, {"number", number == 0 ? "" : std::to_string(number)}};
}

/// What the page holds, each part with as many as it tells of.
List contents(const PlantFacts& facts, const std::vector<AreaCounts>& areas) {
  const storage::PlantCounts& counts = facts.counts;
  List list;
  const auto add = [&](const char* anchor, const char* words, std::int64_t number) {
    if (number > 0) list.emplace_back(entry(anchor, words, number));
  };
  add("work-list", "Work list", std::ssize(facts.flagged));
  if (!facts.flagged.empty()) list.emplace_back(entry("kinds", "What to do", 0));
  add("areas", "Areas", std::ssize(areas));
  add("oscillations", "Plant-wide oscillations", std::ssize(facts.oscillations));
  add("annotated", "Taken off the list", counts.annotations);
  add("repairs", "Repairs", std::ssize(facts.repairs));
  add("open-loops", "Without a controller", std::ssize(counts.without_controller));
  add("unjudged", "Cannot be judged", counts.unjudgeable);
  return list;
}

/// The areas that have sections of their own: those of a report.
List area_contents(const std::vector<AreaCounts>& areas, const LoopLinks& links) {
  List list;
  if (links.is_live()) return list;
  for (const AreaCounts& one : areas)
    if (one.flagged > 0)
      list.emplace_back(entry(area_anchor(one.best_rank), area_words(one.area), one.flagged));
  return list;
}

}  // namespace

std::string area_anchor(std::int64_t best_rank) {
  return fmt::format("area-{}", best_rank);
}

Markup plant_section(const PlantFacts& facts, const LoopLinks& links) {
  const storage::PlantCounts& counts = facts.counts;
  const TimeZone& zone = facts.zone;
  const std::vector<AreaCounts> areas = count_areas(facts.loops);
  const auto address = [&](const AreaCounts& one) { return area_address(one, links); };
  return render("plant_section",
                {{"tiles", tiles(facts)},
                 {"contents", contents(facts, areas)},
                 {"area_contents", area_contents(areas, links)},
                 {"work_list", ranked_list(facts.flagged, facts.since_us, links, zone)},
                 {"any_hidden", counts.victims + counts.annotated + counts.unlisted != 0},
                 {"affected", core::text::counted(counts.victims, "loop", "loops")},
                 {"findings", core::text::counted(counts.annotated, "finding", "findings")},
                 {"faults", core::text::counted(counts.unlisted, "fault", "faults")},
                 {"off_link", links.to_loops("?state=off%20the%20list")},
                 {"kinds", kind_table(facts.flagged, facts.since_us, links)},
                 {"areas", area_table(areas, address)},
                 {"any_event", !facts.oscillations.empty()},
                 {"events", events(facts, links)},
                 {"annotated", annotated_table(counts, links, zone)},
                 {"repairs", repairs_table(newest_repairs(facts.repairs), zone)},
                 {"more_repairs", more_repairs(facts.repairs)},
                 {"idle", idle_loops(counts, links, zone)}});
}

}  // namespace loopscope::daemon
