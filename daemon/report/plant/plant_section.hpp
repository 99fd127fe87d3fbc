#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/report/figures/event_pictures.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/listed_loops.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What the first screen tells.
struct PlantFacts {
  std::string plant;          ///< its name; may be empty
  std::int64_t since_us = 0;  ///< what began after this counts as new
  storage::PlantCounts counts;
  std::vector<storage::FlaggedRow> flagged;  ///< in the order of rank
  std::vector<storage::PlantOscillationRow> oscillations;
  std::vector<storage::RepairRow> repairs;  ///< since `since_us`
  storage::ListedLoops loops = {};          ///< of the catalogue
  EventAlbum album = {};                    ///< trends and spectra of the oscillations
  std::string picture_trouble = {};         ///< why there are none, a sentence; empty = no trouble
  TimeZone zone = {};                       ///< of all times that are told
};

/// The first screen as HTML: counts, the work list, what each kind of fault asks for, the areas,
/// oscillations that loops share, what people said, repairs with their words, loops that have no
/// verdict. A live page shows the head of long lists and leads to the rest.
[[nodiscard]] Markup plant_section(const PlantFacts& facts, const LoopLinks& links);

/// What marks the sections of the area whose worst loop has this rank.
[[nodiscard]] std::string area_anchor(std::int64_t best_rank);

}  // namespace loopscope::daemon
