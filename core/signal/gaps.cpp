#include "core/signal/gaps.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::signal {
namespace {

/// Calls fill(samples, first, last) for each inner run [first, last) of at most `longest` missing
/// samples.
template <typename Fill>
void for_each_short_gap(Samples& samples, std::size_t longest, Fill fill) {
  std::size_t k = 0;
  while (k < samples.size()) {
    if (!std::isnan(samples[k])) {
      ++k;
      continue;
    }
    const std::size_t first = k;
    while (k < samples.size() && std::isnan(samples[k])) ++k;
    const bool inner = first > 0 && k < samples.size();
    if (inner && k - first <= longest) fill(samples, first, k);
  }
}

void draw_line(Samples& samples, std::size_t first, std::size_t last) {
  const double before = samples[first - 1];
  const double step = (samples[last] - before) / static_cast<double>(last - first + 1);
  for (std::size_t k = first; k < last; ++k) {
    samples[k] = before + step * static_cast<double>(k - first + 1);
  }
}

void repeat_last(Samples& samples, std::size_t first, std::size_t last) {
  std::fill(samples.begin() + static_cast<std::ptrdiff_t>(first),
            samples.begin() + static_cast<std::ptrdiff_t>(last), samples[first - 1]);
}

}  // namespace

void discard_infinite(Samples& samples) {
  for (double& value : samples) {
    if (std::abs(value) > kLargestValue) value = kMissing;
  }
}

void bridge_gaps(Samples& samples, std::size_t longest) {
  for_each_short_gap(samples, longest, draw_line);
}

void hold_gaps(Samples& samples, std::size_t longest) {
  for_each_short_gap(samples, longest, repeat_last);
}

std::size_t count_recorded(const Samples& samples) {
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](double v) { return std::isfinite(v); }));
}

}  // namespace loopscope::core::signal
