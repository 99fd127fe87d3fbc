#include "core/signal/base_interval.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/signal/grid.hpp"
#include "core/signal/microseconds.hpp"
#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {
namespace {

/// Spacings that differ from the usual one by less are at it: stamps are rounded.
constexpr double kRounding = 1e-3;
/// So large a share of the spacings at the usual interval leaves no doubt about it.
constexpr double kMostly = 0.9;
/// The usual spacing is at most so many scans: archives that keep fewer rows are beyond any test.
constexpr int kMostScans = 8;
/// An interval agrees as well as the best one when its agreement is this share of the best: with
/// less the longest of the multiples would win by chance, with more the shortest.
constexpr double kAsWell = 0.8;
/// Spacings that agree less jitter too much to tell multiples: 0.27 of an interval, uniformly.
constexpr double kAgreement = 0.4;
/// Longer spacings are gaps, and too long to count their scans before the interval is known well.
constexpr double kLongSpacing = 5.0;

std::vector<double> spacings_of(const RawSeries& rows) {
  std::vector<double> spacings_s;
  for (std::size_t row = 1; row < rows.time_us.size(); ++row) {
    const double spacing_us = elapsed_us(rows.time_us[row - 1], rows.time_us[row]);
    if (spacing_us > 0.0) spacings_s.push_back(spacing_us / kMicrosecondsPerSecond);
  }
  return spacings_s;
}

bool mostly(const std::vector<double>& spacings_s, double interval_s) {
  double at = 0.0;
  for (const double spacing : spacings_s) {
    if (std::abs(spacing - interval_s) <= kRounding * interval_s) at += 1.0;
  }
  return at >= kMostly * static_cast<double>(spacings_s.size());
}

/// 1 when all spacings are multiples of the interval, about 0 when they have nothing to do with it.
double agreement(const std::vector<double>& spacings_s, double interval_s, double longest_s) {
  std::complex<double> sum = 0.0;
  double count = 0.0;
  for (const double spacing : spacings_s) {
    if (spacing > longest_s) continue;
    sum += std::polar(1.0, 2.0 * std::numbers::pi * spacing / interval_s);
    count += 1.0;
  }
  return count > 0.0 ? std::abs(sum) / count : 0.0;
}

/// The slope of the stamps over the scans. Each row's scan is counted from where the grid was a few
/// rows before, so that neither jitter nor an interval that is known to a hundredth only adds up.
double refined(const std::vector<double>& spacings_s, double interval_s) {
  constexpr double kFollow = 0.1;
  double lead_s = 0.0;  // of the row over the grid
  double scan = 0.0;
  double time_s = 0.0;
  double scans = 0.0, times_s = 0.0, square = 0.0, product = 0.0;
  for (const double spacing : spacings_s) {
    const double counted = std::max(0.0, std::round((lead_s + spacing) / interval_s));
    lead_s += spacing - counted * interval_s;
    lead_s -= kFollow * lead_s;
    scan += counted;
    time_s += spacing;
    scans += scan;
    times_s += time_s;
    square += scan * scan;
    product += scan * time_s;
  }
  const auto count = static_cast<double>(spacings_s.size());
  const double spread = square - scans * scans / count;
  return spread > 0.0 ? (product - scans * times_s / count) / spread : interval_s;
}

/// The middle of the spacings around `spacing_s`, where that comes to rest.
double centred(const std::vector<double>& spacings_s, double spacing_s) {
  constexpr double kAround = 0.4;
  constexpr int kMoves = 8;
  for (int i = 0; i < kMoves; ++i) {
    std::vector<double> around;
    for (const double spacing : spacings_s) {
      if (std::abs(spacing - spacing_s) <= kAround * spacing_s) around.push_back(spacing);
    }
    if (!around.empty()) spacing_s = median(std::move(around));
  }
  return spacing_s;
}

/// Common spacings, short ones too, and the intervals of which they may be multiples.
std::vector<double> candidates(const std::vector<double>& spacings_s) {
  constexpr double kQuantiles[] = {0.05, 0.25, 0.5};
  std::vector<double> sorted = spacings_s;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> result;
  for (const double quantile : kQuantiles) {
    const auto place = static_cast<std::size_t>(quantile * static_cast<double>(sorted.size()));
    const double spacing_s = centred(spacings_s, sorted[place]);
    for (int scans = 1; scans <= kMostScans; ++scans) result.push_back(spacing_s / scans);
  }
  std::sort(result.rbegin(), result.rend());
  return result;
}

/// The longest interval that agrees as well as any; the usual one where none agrees.
double best_candidate(const std::vector<double>& spacings_s, double usual_s) {
  const std::vector<double> intervals_s = candidates(spacings_s);
  std::vector<double> agreements;
  for (const double interval_s : intervals_s) {
    agreements.push_back(agreement(spacings_s, interval_s, kLongSpacing * usual_s));
  }
  const double best = *std::max_element(agreements.begin(), agreements.end());
  if (best < kAgreement) return usual_s;
  std::size_t i = 0;
  while (agreements[i] < kAsWell * best) ++i;
  return intervals_s[i];
}

}  // namespace

double base_interval_s(const RawSeries& rows) {
  const double usual_s = usual_interval_s(rows);
  const std::vector<double> spacings_s = spacings_of(rows);
  if (!(usual_s > 0.0) || mostly(spacings_s, usual_s)) return usual_s;
  double interval_s = best_candidate(spacings_s, usual_s);
  constexpr int kRefinements = 4;
  for (int i = 0; i < kRefinements; ++i) interval_s = refined(spacings_s, interval_s);
  return interval_s;
}

}  // namespace loopscope::core::signal
