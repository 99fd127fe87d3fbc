#include "core/loop/actuator.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace loopscope::core::loop {
namespace {

constexpr std::size_t kLongestDelay = 3;
/// Lags apart by a quarter of an octave: one between two of them is off by 9 %, the width of a plot
/// by a few hundredths of op's move from sample to sample. Slower actuators do not control.
constexpr double kShortestLag = 0.3;
constexpr double kLongestLag = 16.0;
constexpr double kLagRatio = 1.189;

/// A lag has to explain most of what the branches leave: noise of mv makes moves of its own, which
/// any lag smooths a little.
constexpr double kWorthALag = 0.5;

signal::Samples passed_on(std::span<const double> op, std::size_t delay, double lag_samples) {
  const double pole = lag_samples > 0.0 ? std::exp(-1.0 / lag_samples) : 0.0;
  signal::Samples out(op.size(), signal::kMissing);
  double state = signal::kMissing;
  for (std::size_t k = delay; k < op.size(); ++k) {
    const double input = op[k - delay];
    if (!std::isfinite(input)) continue;
    state = std::isfinite(state) ? pole * state + (1.0 - pole) * input : input;
    out[k] = state;
  }
  return out;
}

/// Sums about the mean of one branch.
struct Sums {
  double n = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  void add(double input, double position) {
    n += 1.0;
    const double dx = input - x;
    const double dy = position - y;
    x += dx / n;
    y += dy / n;
    xx += dx * (input - x);
    xy += dx * (position - y);
    yy += dy * (position - y);
  }
};

Sums sums_of(const std::vector<std::size_t>& rows, const signal::Samples& input,
             std::span<const double> mv) {
  Sums sums;
  for (const std::size_t k : rows) {
    // The first rows are left out of all, so that delays are compared on the same ones.
    if (k >= kLongestDelay && std::isfinite(input[k])) sums.add(input[k], mv[k]);
  }
  return sums;
}

/// Mean square that two parallel lines leave of mv.
double lines_leave(const Branches& branches, const signal::Samples& input,
                   std::span<const double> mv) {
  const Sums up = sums_of(branches.rising, input, mv);
  const Sums down = sums_of(branches.falling, input, mv);
  if (up.n + down.n == 0.0) return HUGE_VAL;
  const double xx = up.xx + down.xx;
  const double xy = up.xy + down.xy;
  const double explained = xx > 0.0 ? xy * xy / xx : 0.0;
  return (up.yy + down.yy - explained) / (up.n + down.n);
}

}  // namespace

signal::Samples behind_actuator(std::span<const double> op, std::span<const double> mv,
                                const Branches& branches) {
  signal::Samples best(op.begin(), op.end());
  double least = kWorthALag * lines_leave(branches, best, mv);
  if (!std::isfinite(least)) return best;
  for (std::size_t delay = 0; delay <= kLongestDelay; ++delay) {
    double lag_samples = 0.0;
    while (lag_samples <= kLongestLag) {
      signal::Samples input = passed_on(op, delay, lag_samples);
      lag_samples = std::max(kShortestLag, kLagRatio * lag_samples);
      const double left = lines_leave(branches, input, mv);
      if (!(left < least)) continue;
      least = left;
      best = std::move(input);
    }
  }
  return best;
}

}  // namespace loopscope::core::loop
