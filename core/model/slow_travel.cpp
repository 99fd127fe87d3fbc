#include "core/model/slow_travel.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMean = 8;
constexpr std::size_t kFewestMeans = 40;
/// Lags of up to six means, delays of up to three: what is slower than that is a trend.
constexpr std::array kPoles = {0.0, 0.6, 0.85};
constexpr std::array<std::size_t, 3> kDelays = {0, 1, 3};
constexpr std::array kJumps = {0.0, 0.2, 0.5, 1.0};

std::vector<double> means_of(std::span<const double> values) {
  std::vector<double> means;
  double last = std::nan("");
  for (std::size_t from = 0; from + kMean <= values.size(); from += kMean) {
    double sum = 0.0;
    std::size_t known = 0;
    for (const double value : values.subspan(from, kMean)) {
      if (std::isnan(value)) continue;
      sum += value;
      ++known;
    }
    if (known > 0) last = sum / static_cast<double>(known);
    means.push_back(last);
  }
  const auto first = std::ranges::find_if(means, [](double value) { return !std::isnan(value); });
  if (first != means.end()) std::fill(means.begin(), first, *first);
  return means;
}

struct Share {
  double explained = 0.0;
  double gain = 0.0;
};

/// Of pv's variance by a constant, a trend and a lagged flow.
Share share_of(const std::vector<double>& pv, const std::vector<double>& flow, double pole,
               std::size_t delay) {
  using Vector = Eigen::Vector3d;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector right = Vector::Zero();
  double square = 0.0;
  double state = flow.front();
  const auto n = static_cast<double>(pv.size());
  for (std::size_t k = 0; k < pv.size(); ++k) {
    state += (1.0 - pole) * (flow[k < delay ? 0 : k - delay] - state);
    const Vector row(1.0, static_cast<double>(k) / n - 0.5, state - flow.front());
    normal += row * row.transpose();
    right += row * pv[k];
    square += pv[k] * pv[k];
  }
  if (normal(2, 2) <= 0.0) return {};
  const Vector weights = normal.ldlt().solve(right);
  const double variance = square - right[0] * right[0] / n;
  return {variance > 0.0 ? 1.0 - (square - weights.dot(right)) / variance : 0.0, weights[2]};
}

Share best_share(const std::vector<double>& pv, const std::vector<double>& flow) {
  Share best;
  for (const double pole : kPoles) {
    for (const std::size_t delay : kDelays) {
      const Share share = share_of(pv, flow, pole, delay);
      if (share.explained > best.explained) best = share;
    }
  }
  return best;
}

void try_valve(const std::vector<double>& pv, const std::vector<double>& op, const Valve& valve,
               SlowTravel& best) {
  std::vector<double> flow(op.size());
  run_valve(valve, op, flow);
  const Share share = best_share(pv, flow);
  if (share.explained <= best.valve_share) return;
  best.valve_share = share.explained;
  best.gain = share.gain;
  best.valve = valve;
}

double variance_of(const std::vector<double>& values) {
  double sum = 0.0, square = 0.0;
  for (const double value : values) {
    sum += value;
    square += value * value;
  }
  const auto n = static_cast<double>(values.size());
  return square / n - sum / n * sum / n;
}

}  // namespace

bool SlowTravel::sticks() const {
  constexpr double kOfTheRest = 0.8;
  constexpr double kOfAll = 0.08;
  return 1.0 - valve_share <= kOfTheRest * (1.0 - linear_share) &&
         valve_share - linear_share >= kOfAll;
}

std::optional<SlowTravel> judge_slow_travel(std::span<const double> pv,
                                            std::span<const double> op) {
  std::vector<double> pv_means = means_of(pv);
  const std::vector<double> op_means = means_of(op);
  if (pv_means.size() < kFewestMeans || std::isnan(pv_means.front()) ||
      std::isnan(op_means.front()))
    return std::nullopt;
  const auto [low, high] = std::ranges::minmax(op_means);
  if (!(high > low)) return std::nullopt;
  SlowTravel result;
  const double level = pv_means.front();
  for (double& value : pv_means) value -= level;
  result.variance = variance_of(pv_means);
  if (!(result.variance > 0.0)) return std::nullopt;
  result.linear_share = best_share(pv_means, op_means).explained;
  result.valve_share = result.linear_share;
  constexpr double kNarrowest = 0.35, kWidest = 0.95, kStep = 1.07;
  for (double band = kNarrowest; band < kWidest; band *= kStep) {
    for (const double jump : kJumps) {
      for (const double direction : {-1.0, 1.0}) {
        const double stickband = band * (high - low);
        try_valve(pv_means, op_means, {ValveLaw::kano, stickband, jump * stickband, direction},
                  result);
      }
    }
  }
  return result;
}

}  // namespace loopscope::core::model
