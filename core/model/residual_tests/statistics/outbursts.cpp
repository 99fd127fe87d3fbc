#include "core/model/residual_tests/statistics/outbursts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/model/residual_tests/statistics/tails.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

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

/// What an event leaves behind it is no tail of the noise: the highest peaks, and none of the
/// others within so many samples of one of these.
constexpr std::size_t kEventSamples = 16;

bool near(const Peak& a, const Peak& b) {
  const std::size_t apart =
      a.at_sample < b.at_sample ? b.at_sample - a.at_sample : a.at_sample - b.at_sample;
  return apart <= kEventSamples;
}

std::vector<Peak> without_followers(const std::vector<Peak>& descending, std::size_t count) {
  std::vector<Peak> kept;
  for (const Peak& peak : descending) {
    if (kept.size() == count) break;
    const std::span<const Peak> events(kept.data(), std::min(kept.size(), kMostEvents));
    if (std::ranges::none_of(events, [&](const Peak& event) { return near(event, peak); }))
      kept.push_back(peak);
  }
  return kept;
}

Tail tail_of(std::vector<Peak> peaks, std::size_t samples) {
  const std::size_t count = std::max(samples / kSamplesPerPeak, kFewestPeaks);
  const std::size_t followers = kMostEvents * 2 * kEventSamples;
  std::ranges::partial_sort(
      peaks, peaks.begin() + static_cast<std::ptrdiff_t>(std::min(peaks.size(), count + followers)),
      std::greater{}, &Peak::height);
  std::vector<Peak> kept = without_followers(peaks, count + 1);
  if (kept.size() <= count || peaks.size() <= 2 * count) return {};
  Tail tail{std::move(kept), 0.0};
  tail.threshold = tail.peaks.back().height;
  tail.peaks.pop_back();
  return tail;
}

/// The power of the heights whose excesses are taken as exponential: 2 is the tail of Gaussian
/// noise, 1 that of exponential noise, below lie the tails of Student's t.
struct TailPower {
  double power;
  /// Excess, of noise whose logarithmic density falls with that power: with Gamma functions of
  /// multiples of a = 1 / power, G(5a) G(a) / G(3a)^2 - 3. Of 1.75 it is 0.30: it counts as 0,
  /// since no noise of a plant is known to be Gaussian to that.
  double kurtosis;
};
constexpr std::array kPowers = {
    TailPower{0.1, 1e9},   TailPower{0.25, 455.0}, TailPower{0.5, 22.2},
    TailPower{0.75, 6.65}, TailPower{1.0, 3.0},    TailPower{1.25, 1.527},
    TailPower{1.5, 0.762}, TailPower{1.75, 0.0},   TailPower{2.0, 0.0}};
/// A tail may be so much heavier than the bulk of the noise says.
constexpr double kHeavierThanBulk = 25.0;

/// The heaviest kurtosis that the series leaves room for, its highest peaks and what follows them
/// left out.
double heaviest_kurtosis(std::span<const double> series, std::span<const Peak> events) {
  double square = 0.0, fourth = 0.0, count = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double value = series[k];
    const auto close = [&](const Peak& event) { return near(event, {0.0, k}); };
    if (value == 0.0 || std::ranges::any_of(events, close)) continue;
    square += value * value;
    fourth += value * value * value * value;
    count += 1.0;
  }
  const double excess = fourth * count / (square * square) - 3.0;
  const double error = std::sqrt(24.0 / count);
  return kHeavierThanBulk * std::max(0.0, excess) + 3.0 * error;
}

/// Excesses over the threshold by one power, descending.
struct Excesses {
  std::vector<double> values;
  double log_likelihood = 0.0;  ///< of all but the highest ones, which may be events
};

Excesses excesses_of(const Tail& tail, double power) {
  Excesses result;
  const double floor = std::pow(tail.threshold, power);
  for (const Peak& peak : tail.peaks) result.values.push_back(std::pow(peak.height, power) - floor);
  double total = static_cast<double>(kMostEvents) * result.values.at(kMostEvents);
  double slopes = 0.0;
  for (std::size_t i = kMostEvents; i < tail.peaks.size(); ++i) {
    total += result.values[i];
    slopes += std::log(power) + (power - 1.0) * std::log(tail.peaks[i].height);
  }
  const auto seen = static_cast<double>(tail.peaks.size() - kMostEvents);
  result.log_likelihood = seen * std::log(seen / total) + slopes;
  return result;
}

/// p of the j-th highest peak (from 0) as the highest of itself and those below.
std::vector<double> peel(const std::vector<double>& excesses) {
  std::vector<double> p(std::min(kMostEvents, excesses.size()));
  double sum = 0.0;
  for (std::size_t i = excesses.size(); i-- > 0;) {
    sum += excesses[i];
    if (i < p.size())
      p[i] = sum > 0.0 ? largest_share_upper(excesses[i] / sum, excesses.size() - i) : 1.0;
  }
  return p;
}

/// The same, each power believed by its likelihood.
std::vector<double> peel(const Tail& tail, double heaviest) {
  if (tail.peaks.size() <= 2 * kMostEvents || !(tail.threshold > 0.0)) return {};
  std::vector<Excesses> all;
  for (const TailPower& one : kPowers) {
    if (one.kurtosis <= heaviest) all.push_back(excesses_of(tail, one.power));
  }
  const double best = std::ranges::max(all, {}, &Excesses::log_likelihood).log_likelihood;
  std::vector<double> p(kMostEvents, 0.0);
  double weights = 0.0;
  for (const Excesses& one : all) {
    const double weight = std::exp(one.log_likelihood - best);
    const std::vector<double> by_one = peel(one.values);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] += weight * by_one[i];
    weights += weight;
  }
  for (double& value : p) value /= weights;
  return p;
}

Outbursts at_width(std::span<const double> series, std::size_t width, double heaviest) {
  const std::vector<double> sums = moving_sums(series, width);
  const Tail tail = tail_of(peaks_of(sums, width), series.size());
  Outbursts result;
  if (tail.peaks.size() <= 2 * kMostEvents) return result;
  const std::vector<double> p = peel(tail, heaviest);
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
  const Tail tail = tail_of(peaks_of({series.begin(), series.end()}, 1), series.size());
  if (tail.peaks.size() <= kMostEvents) return best;
  const double heaviest = heaviest_kurtosis(series, std::span(tail.peaks).first(kMostEvents));
  for (const std::size_t width : kEventWidths) {
    if (series.size() <= width) break;
    Outbursts found = at_width(series, width, heaviest);
    if (found.p < best.p) best = std::move(found);
  }
  return best;
}

}  // namespace loopscope::core::model
