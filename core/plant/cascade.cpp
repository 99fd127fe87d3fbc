#include "core/plant/cascade.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kFewestPoints = 64;
/// Points of the first look, which spares the full correlation for all but one pair in thousands.
constexpr std::size_t kGlancePoints = 48;
constexpr double kGlanceCorrelation = 0.5;  // at no lag
constexpr double kSecondGlance = 0.9;       // at the best lag
/// Both looks allow for clocks, scans and archives that are apart by so many coarser samples.
constexpr double kLagSamples = 2.0;
/// Two drifts may run in parallel for a while; what moves in between has to agree as well.
constexpr double kMovesCorrelation = 0.8;
/// Part of the finer interval within which two samples are of one time.
constexpr double kSameTime = 0.1;

double start_s(const MemberLoop& loop) {
  return static_cast<double>(loop.start_us) * 1e-6;
}
double end_s(const MemberLoop& loop) {
  return start_s(loop) + static_cast<double>(loop.error.size()) * loop.sample_interval_s;
}

/// The value sampled at a time; NaN outside the window and between the samples.
double value_at(const MemberLoop& loop, std::span<const double> series, double time_s) {
  const double place = (time_s - start_s(loop)) / loop.sample_interval_s;
  const double nearest = std::round(place);
  if (!(std::abs(place - nearest) <= kSameTime && nearest >= 0.0 &&
        nearest < static_cast<double>(series.size())))
    return std::nan("");
  return series[static_cast<std::size_t>(nearest)];
}

/// Pearson's correlation of the pairs that are there; 0 with too few or without variance.
class PairSums {
 public:
  void add(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    count_ += 1.0;
    const double dx = x - mx_, dy = y - my_;
    mx_ += dx / count_;
    my_ += dy / count_;
    xx_ += dx * (x - mx_);
    yy_ += dy * (y - my_);
    xy_ += dx * (y - my_);
  }
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] double correlation() const {
    return xx_ > 0.0 && yy_ > 0.0 ? xy_ / std::sqrt(xx_ * yy_) : 0.0;
  }

 private:
  double count_ = 0.0, mx_ = 0.0, my_ = 0.0, xx_ = 0.0, yy_ = 0.0, xy_ = 0.0;
};

/// More often than steps by hand do: a slow master may move its slave once in many samples.
bool moves(std::span<const double> series) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < series.size(); ++k) {
    const bool known = std::isfinite(series[k]) && std::isfinite(series[k - 1]);
    if (known && series[k] != series[k - 1]) ++count;
  }
  return count >= kFewestPoints;
}

/// A setpoint and an output at common times.
struct Comparison {
  double pairs = 0.0;
  double levels = 0.0;  ///< correlation
  double moves = 0.0;   ///< of the differences from pair to pair
  double still = 0.0;   ///< pairs at which the setpoint had not moved

  [[nodiscard]] bool is_one_signal() const {
    return pairs >= static_cast<double>(kFewestPoints) && 2.0 * still < pairs &&
           std::abs(moves) >= kMovesCorrelation && levels * moves > 0.0;
  }
};

/// Slave and master on the times of the coarser one.
class Pairing {
 public:
  Pairing(const MemberLoop& slave, const MemberLoop& master)
      : slave_(slave),
        master_(master),
        coarse_(slave.sample_interval_s > master.sample_interval_s ? slave : master),
        step_s_(coarse_.sample_interval_s) {
    const double allowed = kLagSamples * step_s_;
    const double from = std::max(start_s(slave), start_s(master)) + allowed;
    const double to = std::min(end_s(slave), end_s(master)) - allowed;
    first_ = std::ceil((from - start_s(coarse_)) / step_s_);
    points_ = to > from ? static_cast<std::size_t>((to - from) / step_s_) : 0;
  }

  [[nodiscard]] std::size_t points() const { return points_; }
  [[nodiscard]] double fine_interval_s() const {
    return std::min(slave_.sample_interval_s, master_.sample_interval_s);
  }
  [[nodiscard]] double coarse_interval_s() const { return step_s_; }

  /// Every `stride`-th point, the output taken `lag_s` before the setpoint.
  [[nodiscard]] Comparison compare(double lag_s, std::size_t stride) const {
    PairSums levels, moves;
    double last_setpoint = std::nan(""), last_output = std::nan("");
    double still = 0.0;
    for (std::size_t k = 0; k < points_; k += stride) {
      const auto [setpoint, output] = at(k, lag_s);
      if (!std::isfinite(setpoint) || !std::isfinite(output)) continue;
      levels.add(setpoint, output);
      moves.add(setpoint - last_setpoint, output - last_output);
      still += setpoint == last_setpoint ? 1.0 : 0.0;
      last_setpoint = setpoint;
      last_output = output;
    }
    return {levels.count(), levels.correlation(), moves.correlation(), still};
  }

 private:
  [[nodiscard]] std::pair<double, double> at(std::size_t k, double lag_s) const {
    const double time = start_s(coarse_) + (first_ + static_cast<double>(k)) * step_s_;
    // The finer record is shifted: the coarser one has no samples in between.
    if (&coarse_ == &slave_)
      return {value_at(slave_, slave_.sp, time), value_at(master_, master_.op, time - lag_s)};
    return {value_at(slave_, slave_.sp, time + lag_s), value_at(master_, master_.op, time)};
  }

  const MemberLoop& slave_;
  const MemberLoop& master_;
  const MemberLoop& coarse_;
  double step_s_;
  double first_ = 0.0;
  std::size_t points_ = 0;
};

/// Two scan classes meet at every second, third or fifth point: a stride that shares no factor with
/// these does not pass them by.
std::size_t glance_stride(std::size_t points) {
  std::size_t stride = std::max<std::size_t>(1, points / kGlancePoints);
  while (stride % 2 == 0 || stride % 3 == 0 || stride % 5 == 0) ++stride;
  return stride;
}

/// The pair at the best of all lags, from every `stride`-th point.
CascadePair best_lag(const Pairing& pairing, std::size_t stride) {
  CascadePair best;
  const double fine = pairing.fine_interval_s();
  const auto steps = static_cast<int>(kLagSamples * pairing.coarse_interval_s() / fine);
  for (int step = -steps; step <= steps; ++step) {
    const Comparison found = pairing.compare(step * fine, stride);
    if (std::abs(found.levels) <= std::abs(best.correlation)) continue;
    if (stride == 1 && !found.is_one_signal()) continue;
    best.correlation = found.levels;
    best.lag_s = step * fine;
  }
  return best;
}

/// Two looks at few points spare the full one for all but a few pairs in a hundred. nullopt = the
/// setpoint is not that output.
std::optional<CascadePair> match(std::span<const MemberLoop> loops, std::size_t s, std::size_t m) {
  const Pairing pairing(loops[s], loops[m]);
  if (pairing.points() < kFewestPoints) return std::nullopt;
  const std::size_t stride = glance_stride(pairing.points());
  if (std::abs(pairing.compare(0.0, stride).levels) < kGlanceCorrelation) return std::nullopt;
  if (std::abs(best_lag(pairing, stride).correlation) < kSecondGlance) return std::nullopt;
  CascadePair best = best_lag(pairing, 1);
  if (std::abs(best.correlation) < kCascadeCorrelation) return std::nullopt;
  best.master = m;
  best.slave = s;
  return best;
}

}  // namespace

std::vector<CascadePair> find_cascade_pairs(std::span<const MemberLoop> loops) {
  std::vector<CascadePair> pairs;
  std::vector<bool> op_moves;
  for (const MemberLoop& loop : loops) op_moves.push_back(moves(loop.op));
  for (std::size_t s = 0; s < loops.size(); ++s) {
    if (!moves(loops[s].sp)) continue;
    std::optional<CascadePair> best;
    for (std::size_t m = 0; m < loops.size(); ++m) {
      if (m == s || !op_moves[m]) continue;
      const std::optional<CascadePair> found = match(loops, s, m);
      if (found && (!best || std::abs(found->correlation) > std::abs(best->correlation)))
        best = found;
    }
    if (best) pairs.push_back(*best);
  }
  return pairs;
}

}  // namespace loopscope::core::plant
