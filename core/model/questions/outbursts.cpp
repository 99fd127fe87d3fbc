#include "core/model/questions/outbursts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/questions/answer.hpp"
#include "core/model/questions/tails.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::array<std::size_t, 5> kEventWidths = {1, 2, 4, 8, 16};
constexpr std::size_t kMostEvents = 5;
/// Peaks that show the tail: a fortieth of the samples, so that it is the tail, and enough of them.
constexpr std::size_t kSamplesPerPeak = 40;
constexpr std::size_t kFewestPeaks = 20;
/// Five widths are looked at, whose sums overlap, and events are peeled off.
constexpr double kEventLooks = 5.0;

std::vector<double> moving_sums(std::span<const double> series, std::size_t width) {
  std::vector<double> sums(series.size() - width + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    sum += series[k];
    if (k + 1 < width) continue;
    sums[k + 1 - width] = sum;
    sum -= series[k + 1 - width];
  }
  return sums;
}

struct Peak {
  double height = 0.0;
  std::size_t at_sample = 0;
};

/// The places that nothing within `width` samples exceeds: one for each outburst.
std::vector<Peak> peaks_of(const std::vector<double>& sums, std::size_t width) {
  std::vector<Peak> peaks;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double height = std::abs(sums[k]);
    if (!peaks.empty() && k - peaks.back().at_sample < width) {
      if (height > peaks.back().height) peaks.back() = {height, k};
    } else {
      peaks.push_back({height, k});
    }
  }
  return peaks;
}

struct Tail {
  std::vector<Peak> peaks;  ///< the highest ones, descending
  double threshold = 0.0;   ///< the height of the next one
};

Tail tail_of(std::vector<Peak> peaks, std::size_t samples) {
  const std::size_t count = std::max(samples / kSamplesPerPeak, kFewestPeaks);
  if (peaks.size() <= 2 * count) return {};
  const auto last = peaks.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(peaks.begin(), last, peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.height > b.height; });
  const double threshold = last->height;
  peaks.resize(count);
  std::sort(peaks.begin(), peaks.end(),
            [](const Peak& a, const Peak& b) { return a.height > b.height; });
  return {std::move(peaks), threshold};
}

/// p of the j-th highest peak (from 0) as the highest of itself and those below.
std::vector<double> peel(const Tail& tail) {
  std::vector<double> p(std::min(kMostEvents, tail.peaks.size()));
  double sum = 0.0;
  for (std::size_t i = tail.peaks.size(); i-- > 0;) {
    const double excess = tail.peaks[i].height - tail.threshold;
    sum += excess;
    if (i < p.size())
      p[i] = sum > 0.0 ? largest_share_upper(excess / sum, tail.peaks.size() - i) : 1.0;
  }
  return p;
}

Outbursts at_width(std::span<const double> series, std::size_t width) {
  const std::vector<double> sums = moving_sums(series, width);
  const Tail tail = tail_of(peaks_of(sums, width), series.size());
  Outbursts result;
  const std::vector<double> p = peel(tail);
  std::size_t events = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double corrected = std::min(1.0, kEventLooks * p[i]);
    result.p = std::min(result.p, corrected);
    if (corrected <= kSignificant) events = i + 1;
  }
  for (std::size_t i = 0; i < events; ++i)
    result.events.push_back({tail.peaks[i].at_sample, width,
                             sums[tail.peaks[i].at_sample] / static_cast<double>(width)});
  return result;
}

}  // namespace

Outbursts find_outbursts(std::span<const double> series) {
  Outbursts best;
  for (const std::size_t width : kEventWidths) {
    if (series.size() <= width) break;
    Outbursts found = at_width(series, width);
    if (found.p < best.p) best = std::move(found);
  }
  return best;
}

}  // namespace loopscope::core::model
