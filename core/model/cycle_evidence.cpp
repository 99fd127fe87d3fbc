#include "core/model/cycle_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/model/half_cycles.hpp"
#include "core/model/op_turns.hpp"
#include "core/model/simulation_fit.hpp"

namespace loopscope::core::model {
namespace {

/// A triangle's peak-to-peak travel over its standard deviation.
constexpr double kTravel = 3.4641;
/// Share of the travel that op has to go back for a turn.
constexpr double kProminence = 0.3;
/// Bands S tried by the law, as shares of the travel: a geometric grid.
constexpr double kLeastBand = 0.2;
constexpr double kBandStep = 1.12;
constexpr int kBands = 18;
constexpr std::array kLawJumps = {0.3, 0.9};
constexpr std::array kTurningBands = {0.5, 0.8, 1.1, 1.5, 2.5};
constexpr std::array kTurningJumps = {0.4, 0.9};
/// Delays of a plausible process, and of a linear model that may explain any shift, cycles.
constexpr double kPlausibleDelay = 0.25;
constexpr double kAnyDelay = 0.6;
/// Share of op's moves that a PI law has to explain before its sign is believed.
constexpr double kKnownController = 0.15;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Sign of the controller: moves of op regressed on the error and its moves.
double controller_sign(std::span<const double> op, std::span<const double> error) {
  double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0, yy = 0.0;
  for (std::size_t k = 1; k < op.size(); ++k) {
    const double move = op[k] - op[k - 1];
    const double step = error[k] - error[k - 1];
    aa += step * step;
    ab += step * error[k];
    bb += error[k] * error[k];
    ay += step * move;
    by += error[k] * move;
    yy += move * move;
  }
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 0.0) || !(yy > 0.0)) return 0.0;
  const double proportional = (ay * bb - by * ab) / determinant;
  const double integral = (aa * by - ab * ay) / determinant;
  if (!(proportional * ay + integral * by > kKnownController * yy)) return 0.0;
  return proportional * std::sqrt(aa) + integral * std::sqrt(bb) > 0.0 ? 1.0 : -1.0;
}

/// The stretch in the band.
struct Banded {
  std::vector<double> pv, op, weights, op_kept;
  double travel = 0.0;
  double sign = 0.0;
};

double travel_of(std::span<const double> op) {
  return kTravel * std::sqrt(dot(op, op) / static_cast<double>(op.size()));
}

Banded to_band(const CycleRecord& record, const CycleBand& band) {
  Banded result;
  result.op_kept = band.resample(record.op);
  result.pv = band.pass(band.resample(record.pv));
  result.op = band.pass(result.op_kept);
  result.weights = band.resample(record.recorded);
  for (double& weight : result.weights) weight = weight > 0.5 ? 1.0 : 0.0;
  result.travel = travel_of(result.op);
  result.sign = controller_sign(result.op, band.pass(band.resample(record.error)));
  return result;
}

using RunValve = void (*)(double, double, std::span<const double>, std::span<const OpTurn>,
                          std::span<double>);

/// op behind a valve, in kept samples.
std::vector<double> behind_valve(RunValve run, double stickband, double jump,
                                 const CycleRecord& record, std::span<const OpTurn> turns,
                                 const CycleBand& band) {
  std::vector<double> position(record.op.size());
  run(stickband, jump, record.op, turns, position);
  return band.resample(position);
}

double square_of_difference(std::span<const double> a, std::span<const double> b,
                            std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += weights[k] * (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// part_ratio and steadiness from the two simulations.
void compare_parts(std::span<const double> linear, std::span<const double> valve,
                   const Banded& banded, std::size_t block, CycleEvidence& evidence) {
  std::vector<double> ratios;
  std::size_t lower = 0;
  for (std::size_t start = 0; start + block <= linear.size(); start += block) {
    const auto part = [&](std::span<const double> x) { return x.subspan(start, block); };
    const double before = square_of_difference(part(linear), part(banded.pv), part(banded.weights));
    const double after = square_of_difference(part(valve), part(banded.pv), part(banded.weights));
    if (!(before > 0.0)) continue;
    ratios.push_back(after / before);
    lower += after < before ? 1 : 0;
  }
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  evidence.part_ratio = *middle;
  evidence.steadiness = static_cast<double>(lower) / static_cast<double>(ratios.size());
}

void read_shapes(const Banded& banded, const CycleBand& band, CycleEvidence& evidence) {
  const std::vector<OpTurn> turns = find_op_turns(banded.op, kProminence * banded.travel);
  if (const auto mean = mean_half_cycle(banded.op, turns)) {
    evidence.op_coherence = mean->coherence;
    evidence.op_triangle = -mean->third_harmonic;
  }
  if (const auto mean = mean_half_cycle(banded.pv, turns)) {
    evidence.pv_third = mean->third_harmonic;
  }
  evidence.pv_triangle = triangle_share(banded.pv, band.period()).value_or(0.5);
}

void describe(const SimulatedProcess& law, const Banded& banded, const CycleBand& band,
              CycleEvidence& evidence) {
  const auto factor = static_cast<double>(band.factor());
  evidence.stickband = law.stickband;
  evidence.slip_jump = law.slip_jump;
  evidence.travel = banded.travel;
  evidence.band_share = law.stickband / banded.travel;
  evidence.delay_samples = static_cast<double>(law.delay) * factor;
  evidence.lag_samples = law.lag * factor;
  evidence.gain = law.gain;
  evidence.integrating = law.lag == kIntegratingLag;
}

}  // namespace

double op_coherence(const CycleRecord& record, const CycleBand& band) {
  const std::vector<double> op = band.pass(band.resample(record.op));
  const auto mean = mean_half_cycle(op, find_op_turns(op, kProminence * travel_of(op)));
  return mean ? mean->coherence : CycleEvidence{}.op_coherence;
}

CycleEvidence gather_cycle_evidence(const CycleRecord& record, const CycleBand& band) {
  const Banded banded = to_band(record, band);
  const std::vector<OpTurn> turns = find_op_turns(record.op, kProminence * banded.travel);
  const auto delay = [&](double cycles) {
    return std::max<std::size_t>(2, static_cast<std::size_t>(cycles * band.period()));
  };
  const auto fit = [&](double cycles) {
    return SimulationFit(band, banded.pv, banded.weights, banded.sign, delay(cycles));
  };
  SimulationFit linear = fit(kAnyDelay);
  linear.offer(banded.op_kept);
  SimulationFit law = fit(kPlausibleDelay);
  double stickband = kLeastBand * banded.travel;
  for (int i = 0; i < kBands; ++i, stickband *= kBandStep) {
    for (const double jump : kLawJumps) {
      law.offer(behind_valve(run_from_first_turn, stickband, jump * stickband, record, turns, band),
                stickband, jump * stickband);
    }
  }
  SimulationFit turning = fit(kPlausibleDelay);
  for (const double share : kTurningBands) {
    for (const double jump : kTurningJumps) {
      const double s = share * banded.travel;
      turning.offer(behind_valve(run_from_every_turn, s, jump * s, record, turns, band), s,
                    jump * s);
    }
  }
  CycleEvidence evidence;
  evidence.error_before = linear.held_out();
  evidence.error_law = law.held_out();
  evidence.error_turning = turning.held_out();
  describe(law.best(), banded, band, evidence);
  const SimulatedProcess& best = turning.best();
  const std::vector<double> input =
      behind_valve(run_from_every_turn, best.stickband, best.slip_jump, record, turns, band);
  compare_parts(linear.simulate(linear.best(), banded.op_kept), turning.simulate(best, input),
                banded, linear.block(), evidence);
  read_shapes(banded, band, evidence);
  return evidence;
}

}  // namespace loopscope::core::model
