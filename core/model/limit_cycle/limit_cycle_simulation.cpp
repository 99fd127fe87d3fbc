#include "core/model/limit_cycle/limit_cycle_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/model/limit_cycle/cycle_fits.hpp"
#include "core/model/limit_cycle/cycle_recording.hpp"
#include "core/model/limit_cycle/hysteresis_from_limit_cycle.hpp"
#include "core/model/limit_cycle/slow_travel.hpp"

namespace loopscope::core::model {
namespace {

/// Straight lines between means of `factor` samples that begin at `from`, each in the middle of its
/// samples.
void draw_between(const std::vector<double>& means, std::size_t factor, std::size_t from,
                  std::vector<double>& series) {
  const auto width = static_cast<double>(factor);
  for (std::size_t k = 0; k < means.size() * factor; ++k) {
    const double at = (static_cast<double>(k) + 0.5) / width - 0.5;
    const double inner = std::clamp(at, 0.0, static_cast<double>(means.size() - 1));
    const auto left = static_cast<std::size_t>(inner);
    const std::size_t right = std::min(left + 1, means.size() - 1);
    series[from + k] = std::lerp(means[left], means[right], inner - static_cast<double>(left));
  }
}

WitnessSimulation nowhere(std::size_t samples) {
  const std::vector<double> none(samples, std::numeric_limits<double>::quiet_NaN());
  return {none, none};
}

std::vector<double> sum(std::vector<double> left, const std::vector<double>& right) {
  std::ranges::transform(left, right, left.begin(), std::plus<>());
  return left;
}

void simulate_part(const CycleRecord& part, const CycleBand& band, bool by_law, std::size_t from,
                   WitnessSimulation& result) {
  const BandedCycle banded = to_band(part, band);
  const CycleFits fits = fit_cycle(part, band, banded);
  const std::vector<double> drift = band.drift(band.resample(part.pv));
  const auto draw = [&](std::vector<double> in_band, std::vector<double>& series) {
    draw_between(sum(std::move(in_band), drift), band.factor(), from, series);
  };
  draw(linear_output(fits, banded), result.linear);
  draw(by_law ? law_output(fits, part, band) : turning_output(fits, part, band), result.valve);
}

std::optional<WitnessSimulation> simulate_cycle(const ModelInput& input) {
  const CycleRecording recording = cycle_recording(input.pv, input.op, input.sp);
  if (!unusable(recording).empty()) return std::nullopt;
  const CycleEvidence evidence = cycle_of(input).evidence;
  const CycleBand band(cycle_period(recording));
  WitnessSimulation result = nowhere(input.pv.size());
  for (const CycleRecord& part : parts_of(recording, band)) {
    const auto from = static_cast<std::size_t>(part.pv.data() - recording.pv.data());
    simulate_part(part, band, evidence.error_law < evidence.error_turning, from, result);
  }
  return result;
}

std::optional<WitnessSimulation> simulate_strokes(const ModelInput& input) {
  const std::optional<SlowTravel> travel = judge_slow_travel(input.pv, input.op);
  if (!travel) return std::nullopt;
  const SimulatedTravel means = simulate_travel(*travel, input.op);
  WitnessSimulation result = nowhere(input.pv.size());
  draw_between(means.linear, kTravelMean, 0, result.linear);
  draw_between(means.valve, kTravelMean, 0, result.valve);
  return result;
}

}  // namespace

std::optional<WitnessSimulation> simulate_limit_cycle(const ModelInput& input, const Step& step) {
  return told_by_strokes(step) ? simulate_strokes(input) : simulate_cycle(input);
}

}  // namespace loopscope::core::model
