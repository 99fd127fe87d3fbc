#include "daemon/report/report_page.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "core/text/counted.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/plant/area_table.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

/// A loop's section, ready.
struct Told {
  std::int64_t loop_id = 0;
  std::string area;  ///< empty = none
  Markup section;
  bool has_pictures = false;
};

std::string title_of(const std::string& plant) {
  return plant.empty() ? "Control loops of the plant" : plant + ": control loops";
}

LoopReport without_pictures(LoopReport loop) {
  const bool was_pictured = !loop.pictures.empty();
  loop.pictures.clear();
  loop.chain.clear();
  if (was_pictured) loop.trouble = kNoRoomForPictures;
  return loop;
}

Markup section_in_words(const LoopReport& loop) {
  return loop_section(loop.pictures.empty() ? loop : without_pictures(loop));
}

/// In words as many as a third of the room holds; the rest is for the pictures of the worst.
std::vector<Told> sections_of(std::span<const LoopReport> loops, std::size_t most_bytes) {
  std::vector<Told> told;
  std::size_t bytes = 0;
  for (const LoopReport& loop : loops) {
    Markup section = section_in_words(loop);
    bytes += section.html.size();
    if (bytes > most_bytes / 3) break;
    told.push_back({loop.row.loop_id, loop.row.area.value_or(""), std::move(section)});
  }
  for (std::size_t k = 0; k < told.size(); ++k) {
    if (loops[k].pictures.empty()) continue;
    Markup section = loop_section(loops[k]);
    bytes += section.html.size() - told[k].section.html.size();
    if (bytes > most_bytes) break;
    told[k].section = std::move(section);
    told[k].has_pictures = true;
  }
  return told;
}

std::set<std::int64_t> ids_of(const std::vector<Told>& told) {
  std::set<std::int64_t> ids;
  for (const Told& one : told) ids.insert(one.loop_id);
  return ids;
}

/// The heading of an area before the first of its loops.
Markup area_heading(const AreaCounts& area, std::int64_t told) {
  return render("area_heading",
                {{"anchor", area_anchor(area.best_rank)},
                 {"area", area_words(area.area)},
                 {"flagged", core::text::counted(area.flagged, "flagged loop", "flagged loops")},
                 {"loops", area.loops},
                 {"missing", told == area.flagged ? "" : std::to_string(area.flagged - told)}});
}

/// Areas in the order of their worst loops, each loop in the order of its rank.
std::vector<Markup> by_area(std::vector<Told>& told, std::vector<AreaCounts> areas) {
  std::erase_if(areas, [](const AreaCounts& one) { return one.flagged == 0; });
  std::ranges::sort(areas, {}, &AreaCounts::best_rank);
  std::vector<Markup> parts;
  for (const AreaCounts& area : areas) {
    const auto here = std::ranges::count(told, area.area, &Told::area);
    parts.push_back(area_heading(area, here));
    for (Told& one : told)
      if (one.area == area.area) parts.push_back(std::move(one.section));
  }
  return parts;
}

std::vector<Markup> in_order(std::vector<Told>& told) {
  std::vector<Markup> parts;
  for (Told& one : told) parts.push_back(std::move(one.section));
  return parts;
}

/// Which loops of the list have no section, in words; empty = all have one.
Markup rest(std::size_t told, std::size_t all, const std::string& pages_address) {
  if (told == all) return {};
  return render("report_rest",
                {{"told", static_cast<std::int64_t>(told)},
                 {"others", core::text::counted(static_cast<std::int64_t>(all - told), "other loop",
                                                "other loops")},
                 {"linked", !pages_address.empty()}});
}

}  // namespace

ReportPage report_page(const PlantFacts& facts, std::span<const LoopReport> loops,
                       const std::string& pages_address, std::size_t most_bytes) {
  // What its links take differs by a few bytes a loop from that of the page.
  const auto bytes_without =
      plant_section(facts, LoopLinks::sections({}, pages_address)).html.size();
  std::vector<Told> told =
      sections_of(loops, most_bytes - std::min(most_bytes, bytes_without + bytes_without / 8));
  const std::size_t sections = told.size();
  const auto pictured =
      static_cast<std::size_t>(std::ranges::count(told, true, &Told::has_pictures));
  std::vector<Markup> parts = {
      plant_section(facts, LoopLinks::sections(ids_of(told), pages_address)),
      rest(sections, loops.size(), pages_address)};
  const std::vector<AreaCounts> areas = count_areas(facts.loops);
  std::ranges::move(areas.empty() ? in_order(told) : by_area(told, areas),
                    std::back_inserter(parts));
  const TimeZone& zone = facts.zone;
  return {page({.title = title_of(facts.plant),
                .subtitle = {"Loopscope report,", minute_in_zone(facts.since_us, zone) + " to",
                             minute_in_zone(facts.counts.now_us, zone)},
                .zone = zone.name()},
               parts),
          sections, pictured};
}

}  // namespace loopscope::daemon
