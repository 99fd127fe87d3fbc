#include "core/model/limit_cycle/simulation_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/limit_cycle/kernels/cycle_kernel.hpp"

namespace loopscope::core::model {
namespace {

/// From "answers within a sample" to half a cycle; slower processes integrate within the band.
constexpr std::array kProcessLags = {0.0, 1.0, 3.0, 8.0, kIntegratingLag};
/// Delays grow denser towards 0, where most processes lie.
constexpr std::array<std::size_t, 8> kDelays = {0, 1, 2, 4, 6, 8, 11, 15};
constexpr double kBlockCycles = 2.0;
constexpr std::size_t kShortestSimulatedBlock = 20;

LagStep step_of(double lag) {
  if (lag == kIntegratingLag) return {1.0, 1.0, true};
  const double pole = lag > 0.0 ? std::exp(-1.0 / lag) : 0.0;
  return {pole, 1.0 - pole, false};
}

double error_of(double pv_square, double gain, double cross, double square) {
  return pv_square - 2.0 * gain * cross + gain * gain * square;
}

}  // namespace

SimulationFit::SimulationFit(const CycleBand& band, std::span<const double> pv,
                             std::span<const double> weights, double gain_sign,
                             std::size_t longest_delay)
    : band_(band),
      pv_(pv),
      weights_(weights),
      weighted_pv_(pv.size()),
      gain_sign_(gain_sign),
      block_(std::max(kShortestSimulatedBlock,
                      static_cast<std::size_t>(kBlockCycles * band.period()))) {
  // pv never answers op within the same sample: a fit without delay finds the controller.
  const std::size_t least = band.factor() > 1 ? 0 : 1;
  for (const std::size_t delay : kDelays) {
    if (delay <= longest_delay) delays_.push_back(delay + least);
  }
  for (std::size_t k = 0; k < pv.size(); ++k) {
    weighted_pv_[k] = weights[k] * pv[k];
    folds_[(k / block_) % 2].pv_square += weights[k] * pv[k] * pv[k];
  }
}

std::vector<std::vector<EightNumbers>> SimulationFit::respond(
    std::span<const double> lags, std::span<const EightNumbers> inputs) const {
  std::vector<LagStep> steps;
  std::vector<std::vector<EightNumbers>> sums;
  std::vector<EightNumbers*> first_sums;
  for (const double lag : lags) {
    steps.push_back(step_of(lag));
    sums.emplace_back(inputs.size() + 1);
    first_sums.push_back(sums.back().data());
  }
  best_cycle_kernel().respond(inputs, steps, first_sums.data());
  return sums;
}

double SimulationFit::gain(const Sums& sums) const {
  if (!(sums.square > 0.0) || sums.cross * gain_sign_ < 0.0) return 0.0;
  return sums.cross / sums.square;
}

void SimulationFit::compare(const std::array<Sums, 2>& sums, SimulatedProcess process) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double g = gain(sums[i]);
    const double error = error_of(folds_[i].pv_square, g, sums[i].cross, sums[i].square);
    if (!(error < folds_[i].best_error)) continue;
    const std::size_t other = 1 - i;
    folds_[i].best_error = error;
    folds_[i].error_elsewhere =
        error_of(folds_[other].pv_square, g, sums[other].cross, sums[other].square);
  }
  const Sums all{sums[0].cross + sums[1].cross, sums[0].square + sums[1].square};
  process.gain = gain(all);
  const double error =
      error_of(folds_[0].pv_square + folds_[1].pv_square, process.gain, all.cross, all.square);
  if (!(error < best_error_)) return;
  best_error_ = error;
  best_ = process;
}

void SimulationFit::offer(std::span<const double> input) {
  offer(eight_times(input), std::array{Valve{}});
}

void SimulationFit::offer(std::span<const EightNumbers> inputs, std::span<const Valve> valves) {
  std::vector<std::array<FoldSums, 2>> sums(kProcessLags.size() * delays_.size());
  auto* of_lag = sums.data();
  for (const std::vector<EightNumbers>& response : respond(kProcessLags, inputs)) {
    best_cycle_kernel().multiply(band_.widths(), response, delays_,
                                 {weighted_pv_, weights_, block_}, of_lag);
    of_lag += delays_.size();
  }
  for (std::size_t v = 0; v < valves.size(); ++v) {
    auto folds = sums.begin();
    for (const double lag : kProcessLags) {
      for (const std::size_t delay : delays_) {
        const auto [first, second] = *folds++;
        compare({Sums{first.cross[v], first.square[v]}, Sums{second.cross[v], second.square[v]}},
                {lag, delay, 0.0, valves[v].stickband_percent, valves[v].slip_jump_percent});
      }
    }
  }
}

double SimulationFit::held_out() const {
  const double all = folds_[0].pv_square + folds_[1].pv_square;
  if (!std::isfinite(best_error_) || !(all > 0.0)) return 1.0;
  return (folds_[0].error_elsewhere + folds_[1].error_elsewhere) / all;
}

std::vector<double> SimulationFit::simulate(const SimulatedProcess& process,
                                            std::span<const double> input) const {
  const auto sums = respond(std::array{process.lag}, eight_times(input));
  const std::vector<double> response = series_at(0, band_.pass_sums(sums[0]));
  std::vector<double> pv(response.size(), 0.0);
  for (std::size_t k = process.delay; k < pv.size(); ++k) {
    pv[k] = process.gain * response[k - process.delay];
  }
  return pv;
}

}  // namespace loopscope::core::model
