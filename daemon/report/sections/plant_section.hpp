#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/report/figures/event_pictures.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/text/time_zone.hpp"
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
  EventAlbum album = {};                    ///< trends and spectra of the oscillations
  std::string picture_trouble = {};         ///< why there are none, a sentence; empty = no trouble
  TimeZone zone = {};                       ///< of all times that are told
};

/// The first screen as HTML: counts, why loops cannot be judged, oscillations that loops share, the
/// ranked list with its factors, repairs with their words.
[[nodiscard]] Markup plant_section(const PlantFacts& facts, LoopLinks links);

}  // namespace loopscope::daemon
