#include "core/plant/event_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/plant/periodogram.hpp"
#include "core/signal/microseconds.hpp"

namespace loopscope::core::plant {
namespace {

constexpr double kFewestShownPeriods = 2.0;
/// Periods of a record below which its spectrum says nothing of a line.
constexpr double kCyclesOfLongest = 3.0;
constexpr std::size_t kFewestForSpectrum = 64;
/// Single bins of a periodogram scatter by as much as they are.
constexpr std::size_t kFewestPooled = 2;

/// Seconds since 1970.
struct Interval {
  double from_s = 0.0;
  double to_s = 0.0;
};

double start_of(const MemberLoop& loop) {
  return static_cast<double>(loop.start_us) / signal::kMicrosecondsPerSecond;
}

/// From the first to the last sample that was recorded; empty: from > to.
Interval record_of(const MemberLoop& loop) {
  const auto known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(loop.error, known);
  const auto last = std::find_if(loop.error.rbegin(), loop.error.rend(), known);
  const auto at = [&](std::ptrdiff_t k) {
    return start_of(loop) + static_cast<double>(k) * loop.sample_interval_s;
  };
  return {at(first - loop.error.begin()), at(last.base() - loop.error.begin() - 1)};
}

Interval shown(double period_s, std::span<const std::size_t> members,
               std::span<const MemberLoop> loops) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  Interval common{-kEver, kEver};
  double newest_s = -kEver;
  for (const std::size_t index : members) {
    const Interval own = record_of(loops[index]);
    common = {std::max(common.from_s, own.from_s), std::min(common.to_s, own.to_s)};
    newest_s = std::max(newest_s, own.to_s);
  }
  const double wanted_s = kPicturedPeriods * period_s;
  if (common.to_s - common.from_s < kFewestShownPeriods * period_s)
    return {newest_s - wanted_s, newest_s};
  return {std::max(common.from_s, common.to_s - wanted_s), common.to_s};
}

/// Of what was recorded; NaN where nothing was.
double recorded_mean(std::span<const double> values) {
  double sum = 0.0, count = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) sum += value, count += 1.0;
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// Means of whole samples: a mean of sometimes two and sometimes three would show a beat that the
/// loop has not.
void trace(MemberPicture& picture, const MemberLoop& loop, const Interval& part) {
  const double interval_s = loop.sample_interval_s;
  const auto last = static_cast<double>(loop.error.size());
  const auto sample = [&](double time_s) {
    return std::clamp(std::ceil((time_s - start_of(loop)) / interval_s - 1e-6), 0.0, last);
  };
  const auto first = static_cast<std::size_t>(sample(part.from_s + 0.5 * interval_s));
  const auto end = static_cast<std::size_t>(sample(part.to_s + interval_s));
  if (first >= end) return;
  const std::size_t pooled = (end - first + kTraceValues - 1) / kTraceValues;
  picture.step_s = static_cast<double>(pooled) * interval_s;
  const double middle_s =
      (static_cast<double>(first) + 0.5 * static_cast<double>(pooled - 1)) * interval_s;
  picture.start_us =
      loop.start_us + static_cast<std::int64_t>(middle_s * signal::kMicrosecondsPerSecond);
  for (std::size_t k = first; k < end; k += pooled)
    picture.error.push_back(recorded_mean(loop.error.subspan(k, std::min(pooled, end - k))));
}

/// From `bin` on, over a column of the logarithmic axis and kFewestPooled bins at least.
std::size_t column_end(std::size_t bin, std::size_t first, double columns_per_e) {
  const double column =
      std::floor(std::log(static_cast<double>(bin) / static_cast<double>(first)) * columns_per_e +
                 1e-9) +
      1.0;
  const double edge = static_cast<double>(first) * std::exp(column / columns_per_e);
  return std::max(bin + kFewestPooled, static_cast<std::size_t>(std::ceil(edge - 1e-9)));
}

/// Power per unit of ln(period), from the longest period to the shortest.
void pool(MemberPicture& picture, std::span<const double> power, std::size_t first,
          double duration_s) {
  const double columns_per_e =
      static_cast<double>(kSpectrumValues) /
      std::log(static_cast<double>(power.size()) / static_cast<double>(first));
  for (std::size_t bin = first; bin < power.size();) {
    const std::size_t end = std::min(column_end(bin, first, columns_per_e), power.size());
    const auto column = power.subspan(bin, end - bin);
    const double mean =
        std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
    const double middle = 0.5 * static_cast<double>(bin + end - 1);
    picture.periods_s.push_back(duration_s / middle);
    picture.power.push_back(mean * middle);
    bin = end;
  }
}

/// Shares of the error's power.
void spectrum(MemberPicture& picture, const MemberLoop& loop) {
  Periodogram found = hann_periodogram(loop.error, kFewestForSpectrum);
  if (found.power.empty()) return;
  const double total = std::accumulate(found.power.begin(), found.power.end(), 0.0);
  for (double& one : found.power) one /= total > 0.0 ? total : 1.0;
  const auto first = static_cast<std::size_t>(std::ceil(kCyclesOfLongest * found.stretch));
  pool(picture, found.power, first, found.samples * found.stretch * loop.sample_interval_s);
  std::ranges::reverse(picture.periods_s);
  std::ranges::reverse(picture.power);
}

}  // namespace

std::vector<MemberPicture> picture_event(double period_s, std::span<const std::size_t> members,
                                         std::span<const MemberLoop> loops) {
  const auto drawn = members.first(std::min(kMostPictured, members.size()));
  const Interval part = shown(period_s, drawn, loops);
  std::vector<MemberPicture> pictures;
  for (const std::size_t index : drawn) {
    MemberPicture& picture = pictures.emplace_back();
    picture.index = index;
    if (loops[index].error.empty()) continue;
    trace(picture, loops[index], part);
    spectrum(picture, loops[index]);
  }
  return pictures;
}

}  // namespace loopscope::core::plant
