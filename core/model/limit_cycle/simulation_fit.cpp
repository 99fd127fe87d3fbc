#include "core/model/limit_cycle/simulation_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace loopscope::core::model {
namespace {

/// From "answers within a sample" to half a cycle; slower processes integrate within the band.
constexpr std::array kProcessLags = {0.0, 1.0, 3.0, 8.0, kIntegratingLag};
/// Delays grow denser towards 0, where most processes lie.
constexpr std::array<std::size_t, 8> kDelays = {0, 1, 2, 4, 6, 8, 11, 15};
constexpr double kBlockCycles = 2.0;
constexpr std::size_t kShortestSimulatedBlock = 20;

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
      gain_sign_(gain_sign),
      block_(std::max(kShortestSimulatedBlock,
                      static_cast<std::size_t>(kBlockCycles * band.period()))) {
  // pv never answers op within the same sample: a fit without delay finds the controller.
  const std::size_t least = band.factor() > 1 ? 0 : 1;
  for (const std::size_t delay : kDelays) {
    if (delay <= longest_delay) delays_.push_back(delay + least);
  }
  for (std::size_t k = 0; k < pv.size(); ++k) {
    folds_[(k / block_) % 2].pv_square += weights[k] * pv[k] * pv[k];
  }
}

/// Every lag's answer at once: none waits for the one before it.
template <std::size_t lag_count>
std::array<std::vector<double>, lag_count> SimulationFit::respond(
    const std::array<double, lag_count>& lags, std::span<const double> input) const {
  const double mean = std::accumulate(input.begin(), input.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, input.size()));
  std::array<double, lag_count> pole{}, share{}, state{}, sum{};
  std::array<std::vector<double>, lag_count> sums;
  for (std::size_t i = 0; i < lag_count; ++i) {
    const bool integrates = lags[i] == kIntegratingLag;
    pole[i] = integrates ? 1.0 : lags[i] > 0.0 ? std::exp(-1.0 / lags[i]) : 0.0;
    share[i] = integrates ? 1.0 : 1.0 - pole[i];
    state[i] = integrates || input.empty() ? 0.0 : input[0] - mean;
    sums[i].resize(input.size() + 1);
  }
  for (std::size_t k = 0; k < input.size(); ++k) {
    for (std::size_t i = 0; i < lag_count; ++i) {
      state[i] = pole[i] * state[i] + share[i] * (input[k] - mean);
      sum[i] += state[i];
      sums[i][k + 1] = sum[i];
    }
  }
  std::array<std::vector<double>, lag_count> responses;
  for (std::size_t i = 0; i < lag_count; ++i) responses[i] = band_.pass_sums(sums[i]);
  return responses;
}

std::array<SimulationFit::Sums, 2> SimulationFit::sums(std::span<const double> response,
                                                       std::size_t delay) const {
  std::array<Sums, 2> result;
  for (std::size_t start = 0; start < pv_.size(); start += block_) {
    const std::size_t end = std::min(pv_.size(), start + block_);
    const std::size_t first = std::max(start, delay);
    if (first >= end) continue;
    const auto count = static_cast<Eigen::Index>(end - first);
    const Eigen::Map<const Eigen::ArrayXd> x(response.data() + (first - delay), count);
    const Eigen::Map<const Eigen::ArrayXd> y(pv_.data() + first, count);
    const Eigen::Map<const Eigen::ArrayXd> w(weights_.data() + first, count);
    Sums& fold = result[(start / block_) % 2];
    fold.cross += (w * x * y).sum();
    fold.square += (w * x * x).sum();
  }
  return result;
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

void SimulationFit::offer(std::span<const double> input, double stickband, double slip_jump) {
  const auto responses = respond(kProcessLags, input);
  for (std::size_t i = 0; i < kProcessLags.size(); ++i) {
    for (const std::size_t delay : delays_) {
      compare(sums(responses[i], delay), {kProcessLags[i], delay, 0.0, stickband, slip_jump});
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
  const std::vector<double> response = respond(std::array{process.lag}, input)[0];
  std::vector<double> pv(response.size(), 0.0);
  for (std::size_t k = process.delay; k < pv.size(); ++k) {
    pv[k] = process.gain * response[k - process.delay];
  }
  return pv;
}

}  // namespace loopscope::core::model
