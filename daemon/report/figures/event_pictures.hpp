#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <vector>

#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// The figures of every event that is drawn, one after the other, and what became of them.
struct EventAlbum {
  std::vector<Figure> figures;
  std::vector<std::int64_t> numbers;  ///< of the event that each figure is of
  std::vector<Picture> pictures;      ///< of the figures, once drawn; else empty

  /// Those of one event; empty = not drawn.
  [[nodiscard]] std::vector<Picture> of_event(std::int64_t number) const;
  /// Whether the other one's pictures would be the same.
  [[nodiscard]] bool shows_the_same(const EventAlbum& other) const;
};

/// Of the events with most loops, a dozen at most: a page with more is not read to its end.
[[nodiscard]] EventAlbum event_album(std::span<const storage::PlantOscillationRow> events,
                                     const TimeZone& zone);

}  // namespace loopscope::daemon
