#include "core/loop/valve_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/loop/actuator.hpp"
#include "core/loop/if_finite.hpp"
#include "core/loop/valve_work.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// Moves of mv below this share of its swing, or below what a position transmitter resolves, are
/// noise. The smaller counts: a valve that moves by half a percent in all still has its branches.
constexpr double kShareOfSwing = 0.02;
constexpr double kTransmitterPercent = 0.1;
constexpr double kNoiseOfSwing = 0.05;
/// Slices of mv in which the branches are compared, so that a valve with a bent characteristic is
/// compared with itself at the same position.
constexpr std::size_t kSlices = 20;

struct Mean {
  double sum = 0.0;
  double count = 0.0;
  void add(double value) {
    sum += value;
    count += 1.0;
  }
  void add(const Mean& more) {
    sum += more.sum;
    count += more.count;
  }
  [[nodiscard]] double value() const { return sum / count; }
};

struct Slice {
  Mean rising, falling;  // of op - mv: free of where in the slice the samples lie
};

using Slices = std::array<Slice, kSlices>;

/// Five standard deviations of the noise of a valve that rests in half of the samples or more: the
/// lower quartile of the moves from sample to sample is 0.45 of one. Of a valve that never rests it
/// is a move.
double resting_noise(std::span<const double> mv) {
  constexpr double kNoise = 5.0 / 0.45;
  std::vector<double> moves;
  for (std::size_t k = 1; k < mv.size(); ++k) {
    if (const double move = std::abs(mv[k] - mv[k - 1]); std::isfinite(move)) moves.push_back(move);
  }
  if (moves.empty()) return 0.0;
  const auto quartile = moves.begin() + static_cast<std::ptrdiff_t>(moves.size() / 4);
  std::nth_element(moves.begin(), quartile, moves.end());
  return kNoise * *quartile;
}

double valve_tolerance(std::span<const double> mv, const signal::Spread& spread) {
  const double swing = spread.high - spread.low;
  const double least = std::min(kShareOfSwing * swing, kTransmitterPercent);
  const double most = std::min(kNoiseOfSwing * swing, kTransmitterPercent);
  return std::max({least, std::min(resting_noise(mv), most), move_tolerance(mv)});
}

/// A sample is on a branch when mv has left its last resting place by more than the tolerance.
Branches find_branches(std::span<const double> op, std::span<const double> mv,
                       const signal::Spread& spread) {
  const double tolerance = valve_tolerance(mv, spread);
  Branches branches;
  double rest = std::nan("");
  for (std::size_t k = 0; k < mv.size(); ++k) {
    if (!std::isfinite(op[k]) || !std::isfinite(mv[k])) {
      rest = std::nan("");
      continue;
    }
    const double move = mv[k] - rest;
    if (std::abs(move) <= tolerance) continue;
    rest = mv[k];
    if (!std::isnan(move)) (move > 0.0 ? branches.rising : branches.falling).push_back(k);
  }
  return branches;
}

Slices slices_of(const Branches& branches, const signal::Samples& input, std::span<const double> mv,
                 const signal::Spread& spread) {
  Slices slices;
  const auto add = [&](std::size_t k, Mean Slice::*branch) {
    const double position = (mv[k] - spread.low) / (spread.high - spread.low);
    Slice& slice = slices[std::min(kSlices - 1, static_cast<std::size_t>(position * kSlices))];
    if (std::isfinite(input[k])) (slice.*branch).add(input[k] - mv[k]);
  };
  for (const std::size_t k : branches.rising) add(k, &Slice::rising);
  for (const std::size_t k : branches.falling) add(k, &Slice::falling);
  return slices;
}

/// A valve that only jumps rises onto one position and falls onto another: no slice holds both
/// branches, but all slices together do.
Slices pooled(const Slices& slices) {
  Slices pool;
  for (const Slice& slice : slices) {
    pool.front().rising.add(slice.rising);
    pool.front().falling.add(slice.falling);
  }
  return pool;
}

std::optional<double> mean_width(const Slices& slices) {
  double sum = 0.0;
  double weights = 0.0;
  for (const Slice& slice : slices) {
    const double weight = std::min(slice.rising.count, slice.falling.count);
    if (!(weight > 0.0)) continue;
    sum += weight * (slice.rising.value() - slice.falling.value());
    weights += weight;
  }
  if (!(weights > 0.0)) return std::nullopt;
  return if_finite(std::max(0.0, sum / weights));
}

std::optional<double> branch_width(const Slices& slices) {
  const std::optional<double> width = mean_width(slices);
  return width ? width : mean_width(pooled(slices));
}

std::optional<double> slip_jump_of(std::span<const double> op, std::span<const double> mv,
                                   const signal::Spread& mv_spread) {
  const double tolerance = valve_tolerance(mv, mv_spread);
  Mean excess;
  bool rested = false;
  for (std::size_t k = 1; k < op.size(); ++k) {
    const double mv_move = std::abs(mv[k] - mv[k - 1]);
    const double op_move = std::abs(op[k] - op[k - 1]);
    const bool moves = mv_move > tolerance;
    if (moves && rested && std::isfinite(op_move)) excess.add(mv_move - op_move);
    rested = std::isfinite(mv_move) && !moves;
  }
  if (!(excess.count > 0.0)) return std::nullopt;
  return if_finite(std::max(0.0, excess.value()));
}

std::optional<double> stuck_fraction_of(std::span<const double> op, std::span<const double> mv,
                                        const signal::Spread& mv_spread) {
  const double op_tolerance = move_tolerance(op);
  const double mv_tolerance = valve_tolerance(mv, mv_spread);
  double moves = 0.0;
  double stuck = 0.0;
  for (std::size_t k = 1; k < op.size(); ++k) {
    const double op_move = std::abs(op[k] - op[k - 1]);
    const double mv_move = std::abs(mv[k] - mv[k - 1]);
    if (!std::isfinite(mv_move) || !std::isfinite(op_move) || !(op_move > op_tolerance)) continue;
    moves += 1.0;
    // A slow ramp moves mv by less than the tolerance per sample, but by as much as op.
    if (mv_move <= std::min(mv_tolerance, 0.1 * op_move)) stuck += 1.0;
  }
  if (!(moves > 0.0)) return std::nullopt;
  return stuck / moves;
}

}  // namespace

ValvePlot measure_valve_plot(std::span<const double> op, std::span<const double> mv) {
  const auto op_spread = signal::measure_spread(op);
  const auto mv_spread = signal::measure_spread(mv);
  if (op.size() != mv.size() || !op_spread || !mv_spread || op_spread->constant() ||
      mv_spread->constant()) {
    return {};
  }
  const Branches branches = find_branches(op, mv, *mv_spread);
  const signal::Samples input = behind_actuator(op, mv, branches);
  return {branch_width(slices_of(branches, input, mv, *mv_spread)),
          slip_jump_of(input, mv, *mv_spread), stuck_fraction_of(op, mv, *mv_spread)};
}

}  // namespace loopscope::core::loop
