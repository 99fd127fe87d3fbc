#include "core/model/limit_cycle/cycle_fits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace loopscope::core::model {
namespace {

/// A triangle's peak-to-peak travel over its standard deviation.
constexpr double kTravel = 3.4641;
/// Bands S tried by the law, as shares of the travel: a geometric grid.
constexpr double kLeastBand = 0.2;
constexpr double kCycleBandStep = 1.12;
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

using RunValves = void (*)(std::vector<Valve>, std::span<const double>, std::span<const OpTurn>,
                           std::span<EightNumbers>);

/// op behind up to eight valves, in kept samples.
std::vector<EightNumbers> behind_valves(RunValves run, const std::vector<Valve>& valves,
                                        const CycleRecord& record, std::span<const OpTurn> turns,
                                        const CycleBand& band) {
  std::vector<EightNumbers> positions(record.op.size());
  run(valves, record.op, turns, positions);
  return band.resample(positions);
}

std::vector<double> best_output(const SimulationFit& fit, RunValves run, const CycleFits& fits,
                                const CycleRecord& record, const CycleBand& band) {
  const SimulatedProcess& best = fit.best();
  const Valve valve{ValveLaw::he, best.stickband, best.slip_jump};
  return fit.simulate(best, series_at(0, behind_valves(run, {valve}, record, fits.turns, band)));
}

/// Bands of a geometric grid, each with every jump.
std::vector<Valve> law_valves(double travel) {
  std::vector<Valve> valves;
  double stickband = kLeastBand * travel;
  for (int i = 0; i < kBands; ++i, stickband *= kCycleBandStep) {
    for (const double jump : kLawJumps)
      valves.push_back({ValveLaw::he, stickband, jump * stickband});
  }
  return valves;
}

std::vector<Valve> turning_valves(double travel) {
  std::vector<Valve> valves;
  for (const double share : kTurningBands) {
    const double s = share * travel;
    for (const double jump : kTurningJumps) valves.push_back({ValveLaw::he, s, jump * s});
  }
  return valves;
}

void offer_all(const std::vector<Valve>& valves, RunValves run, const CycleRecord& record,
               std::span<const OpTurn> turns, const CycleBand& band, SimulationFit& fit) {
  for (auto first = valves.begin(); first != valves.end();) {
    const auto count = std::min<std::ptrdiff_t>(kSideBySide, valves.end() - first);
    const std::vector<Valve> some(first, first + count);
    fit.offer(behind_valves(run, some, record, turns, band), some);
    first += count;
  }
}

SimulationFit empty_fit(const CycleBand& band, const BandedCycle& banded, double delay_cycles) {
  const auto delay =
      std::max<std::size_t>(2, static_cast<std::size_t>(delay_cycles * band.period()));
  return {band, banded.pv, banded.weights, banded.sign, delay};
}

}  // namespace

double travel_of(std::span<const double> op) {
  return kTravel * std::sqrt(dot(op, op) / static_cast<double>(op.size()));
}

BandedCycle to_band(const CycleRecord& record, const CycleBand& band) {
  BandedCycle result;
  result.op_kept = band.resample(record.op);
  result.pv = band.pass(band.resample(record.pv));
  result.op = band.pass(result.op_kept);
  result.weights = band.resample(record.recorded);
  for (double& weight : result.weights) weight = weight > 0.5 ? 1.0 : 0.0;
  result.travel = travel_of(result.op);
  result.sign = controller_sign(result.op, band.pass(band.resample(record.error)));
  return result;
}

CycleFits fit_cycle(const CycleRecord& record, const CycleBand& band, const BandedCycle& banded) {
  CycleFits fits{find_op_turns(record.op, kTurnProminence * banded.travel),
                 empty_fit(band, banded, kAnyDelay), empty_fit(band, banded, kPlausibleDelay),
                 empty_fit(band, banded, kPlausibleDelay)};
  fits.linear.offer(banded.op_kept);
  offer_all(law_valves(banded.travel), run_from_first_turn, record, fits.turns, band, fits.law);
  offer_all(turning_valves(banded.travel), run_from_every_turn, record, fits.turns, band,
            fits.turning);
  return fits;
}

std::vector<double> linear_output(const CycleFits& fits, const BandedCycle& banded) {
  return fits.linear.simulate(fits.linear.best(), banded.op_kept);
}

std::vector<double> law_output(const CycleFits& fits, const CycleRecord& record,
                               const CycleBand& band) {
  return best_output(fits.law, run_from_first_turn, fits, record, band);
}

std::vector<double> turning_output(const CycleFits& fits, const CycleRecord& record,
                                   const CycleBand& band) {
  return best_output(fits.turning, run_from_every_turn, fits, record, band);
}

}  // namespace loopscope::core::model
