#include "core/hos/segments.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {

std::size_t segment_hop(const Settings& settings) {
  const double length = static_cast<double>(settings.segment_length);
  const auto repeated = static_cast<std::size_t>(std::lround(settings.overlap * length));
  return settings.segment_length - std::min(repeated, settings.segment_length - 1);
}

std::vector<std::size_t> segment_starts(std::span<const double> signal, const Settings& settings) {
  const std::size_t length = settings.segment_length;
  const std::size_t hop = segment_hop(settings);
  std::vector<std::size_t> starts;
  std::size_t checked = 0;    // samples before this one have been looked at
  std::size_t after_gap = 0;  // one past the last missing sample among them
  for (std::size_t start = 0; start + length <= signal.size(); start += hop) {
    for (; checked < start + length; ++checked) {
      after_gap = std::isfinite(signal[checked]) ? after_gap : checked + 1;
    }
    if (start >= after_gap) {
      starts.push_back(start);
    }
  }
  return starts;
}

}  // namespace loopscope::core::hos
