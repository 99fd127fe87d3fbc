#include "core/model/limit_cycle/cycle_evidence.hpp"

#include <algorithm>
#include <cstddef>

#include "core/model/limit_cycle/cycle_fits.hpp"
#include "core/model/limit_cycle/half_cycles.hpp"

namespace loopscope::core::model {
namespace {

double square_of_difference(std::span<const double> a, std::span<const double> b,
                            std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += weights[k] * (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// part_ratio and steadiness from the two simulations.
void compare_parts(std::span<const double> linear, std::span<const double> valve,
                   const BandedCycle& banded, std::size_t block, CycleEvidence& evidence) {
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

void read_shapes(const BandedCycle& banded, const CycleBand& band, CycleEvidence& evidence) {
  const std::vector<OpTurn> turns = find_op_turns(banded.op, kTurnProminence * banded.travel);
  if (const auto mean = mean_half_cycle(banded.op, turns)) {
    evidence.op_coherence = mean->coherence;
    evidence.op_triangle = -mean->third_harmonic;
  }
  if (const auto mean = mean_half_cycle(banded.pv, turns)) {
    evidence.pv_third = mean->third_harmonic;
  }
  evidence.pv_triangle = triangle_share(banded.pv, band.period()).value_or(0.5);
}

void describe(const SimulatedProcess& law, const BandedCycle& banded, const CycleBand& band,
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
  const auto mean = mean_half_cycle(op, find_op_turns(op, kTurnProminence * travel_of(op)));
  return mean ? mean->coherence : CycleEvidence{}.op_coherence;
}

CycleEvidence gather_cycle_evidence(const CycleRecord& record, const CycleBand& band) {
  const BandedCycle banded = to_band(record, band);
  const CycleFits fits = fit_cycle(record, band, banded);
  CycleEvidence evidence;
  evidence.error_before = fits.linear.held_out();
  evidence.error_law = fits.law.held_out();
  evidence.error_turning = fits.turning.held_out();
  describe(fits.law.best(), banded, band, evidence);
  compare_parts(linear_output(fits, banded), turning_output(fits, record, band), banded,
                fits.linear.block(), evidence);
  read_shapes(banded, band, evidence);
  return evidence;
}

}  // namespace loopscope::core::model
