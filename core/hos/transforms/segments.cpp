#include "core/hos/transforms/segments.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {

std::size_t segment_hop(const Settings& settings) {
  const auto length = static_cast<double>(settings.segment_length);
  const auto repeated = static_cast<std::size_t>(std::lround(settings.overlap * length));
  return settings.segment_length - std::min(repeated, settings.segment_length - 1);
}

std::vector<std::size_t> segment_starts(std::span<const double> signal, const Settings& settings) {
  std::vector<std::size_t> starts;
  find_segments(signal, false, settings, starts);
  for (std::size_t& start : starts) start *= segment_hop(settings);
  return starts;
}

void find_segments(std::span<const double> signal, bool complete, const Settings& settings,
                   std::vector<std::size_t>& positions) {
  const std::size_t length = settings.segment_length;
  const std::size_t hop = segment_hop(settings);
  positions.clear();
  std::size_t checked = complete ? signal.size() : 0;  // samples before this one are known
  std::size_t after_gap = 0;                           // one past the last missing one among them
  std::size_t place = 0;
  for (std::size_t start = 0; start + length <= signal.size(); start += hop, ++place) {
    for (; checked < start + length; ++checked) {
      after_gap = std::isfinite(signal[checked]) ? after_gap : checked + 1;
    }
    if (start >= after_gap) positions.push_back(place);
  }
}

}  // namespace loopscope::core::hos
