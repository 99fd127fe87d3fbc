#include "daemon/report/figures/event_pictures.hpp"

#include <algorithm>
#include <utility>

#include "daemon/report/figures/event_figures.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::size_t kMostDrawnEvents = 12;

}  // namespace

std::vector<Picture> EventAlbum::of_event(std::int64_t number) const {
  std::vector<Picture> found;
  for (std::size_t k = 0; k < pictures.size(); ++k)
    if (numbers[k] == number) found.push_back(pictures[k]);
  return found;
}

bool EventAlbum::shows_the_same(const EventAlbum& other) const {
  return numbers == other.numbers &&
         std::ranges::equal(figures, other.figures, {}, &Figure::script, &Figure::script);
}

EventAlbum event_album(std::span<const storage::PlantOscillationRow> events, const TimeZone& zone) {
  EventAlbum album;
  for (const auto& event : events.first(std::min(kMostDrawnEvents, events.size()))) {
    for (Figure& figure : event_figures(event, zone)) {
      album.figures.push_back(std::move(figure));
      album.numbers.push_back(event.number);
    }
  }
  return album;
}

}  // namespace loopscope::daemon
