#include "core/model/limit_cycle/slow_travel.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kFewestMeans = 40;
/// Lags of up to a hundred means, delays of up to three: a lag that the linear rival lacks looks
/// like a valve that comes late.
constexpr std::array kMeanPoles = {0.0, 0.6, 0.85, 0.95, 0.99};
constexpr std::array<std::size_t, 3> kMeanDelays = {0, 1, 3};
constexpr std::array kJumps = {0.0, 0.2, 0.5, 1.0};

std::vector<double> means_of(std::span<const double> values) {
  std::vector<double> means;
  double last = std::nan("");
  for (std::size_t from = 0; from + kTravelMean <= values.size(); from += kTravelMean) {
    double sum = 0.0;
    std::size_t known = 0;
    for (const double value : values.subspan(from, kTravelMean)) {
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
  double fitted = -1.0;  ///< of pv's variance on the blocks that are fitted
  double scored = 0.0;   ///< on those held out
  TravelModel model;
};

constexpr std::size_t kBlock = 6;
bool is_fitted(std::size_t k) {
  return k / kBlock % 2 == 0;
}

/// A constant, a trend and the lagged flow.
Eigen::MatrixX3d regressors(const std::vector<double>& flow, double pole, std::size_t delay) {
  const auto n = static_cast<double>(flow.size());
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(flow.size()), 3);
  double state = flow.front();
  for (std::size_t k = 0; k < flow.size(); ++k) {
    state += (1.0 - pole) * (flow[k < delay ? 0 : k - delay] - state);
    rows.row(static_cast<Eigen::Index>(k)) << 1.0, static_cast<double>(k) / n - 0.5,
        state - flow.front();
  }
  return rows;
}

/// One less the mean square that `weights` leave by the variance, on the blocks of one kind.
double explained(const std::vector<double>& pv, const Eigen::MatrixX3d& rows,
                 const Eigen::Vector3d& weights, bool fitted) {
  double sum = 0.0, square = 0.0, left = 0.0, count = 0.0;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (is_fitted(k) != fitted) continue;
    const double rest = pv[k] - rows.row(static_cast<Eigen::Index>(k)).dot(weights);
    left += rest * rest;
    sum += pv[k];
    square += pv[k] * pv[k];
    count += 1.0;
  }
  const double variance = square - sum * sum / count;
  return variance > 0.0 ? 1.0 - left / variance : 0.0;
}

Share share_of(const std::vector<double>& pv, const std::vector<double>& flow, double pole,
               std::size_t delay) {
  const Eigen::MatrixX3d rows = regressors(flow, pole, delay);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (!is_fitted(k)) continue;
    const Eigen::Vector3d row = rows.row(static_cast<Eigen::Index>(k));
    normal += row * row.transpose();
    right += row * pv[k];
  }
  if (normal(2, 2) <= 0.0) return {};
  const Eigen::Vector3d weights = normal.ldlt().solve(right);
  return {explained(pv, rows, weights, true),
          explained(pv, rows, weights, false),
          {pole, delay, {weights[0], weights[1], weights[2]}}};
}

Share best_share(const std::vector<double>& pv, const std::vector<double>& flow) {
  Share best;
  for (const double pole : kMeanPoles) {
    for (const std::size_t delay : kMeanDelays) {
      const Share share = share_of(pv, flow, pole, delay);
      if (share.fitted > best.fitted) best = share;
    }
  }
  return best;
}

std::vector<double> behind(const Valve& valve, const std::vector<double>& op) {
  std::vector<double> flow(op.size());
  run_valve(valve, op, flow);
  return flow;
}

std::vector<double> output_of(const TravelModel& model, const std::vector<double>& flow,
                              double level) {
  const Eigen::Vector3d weights(model.weights.data());
  const Eigen::VectorXd output = regressors(flow, model.pole, model.delay) * weights;
  std::vector<double> pv(flow.size());
  std::ranges::transform(output, pv.begin(), [&](double value) { return level + value; });
  return pv;
}

/// Returns the share on the fitted blocks, by which valves are ranked.
double try_valve(const std::vector<double>& pv, const std::vector<double>& op, const Valve& valve,
                 double to_beat, SlowTravel& best) {
  const Share share = best_share(pv, behind(valve, op));
  if (share.fitted <= to_beat) return to_beat;
  best.valve_share = share.scored;
  best.valve_model = share.model;
  best.valve = valve;
  return share.fitted;
}

}  // namespace

bool SlowTravel::sticks() const {
  constexpr double kOfTheRest = 0.6;
  constexpr double kOfAll = 0.04;
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
  const double travel = high - low;
  if (!(travel > 0.0) || std::isinf(travel)) return std::nullopt;
  SlowTravel result;
  result.level = pv_means.front();
  for (double& value : pv_means) value -= result.level;
  const auto spread = signal::measure_spread(pv_means);
  if (!spread || spread->constant()) return std::nullopt;
  result.variance = spread->std * spread->std;
  const Share linear = best_share(pv_means, op_means);
  result.linear_share = result.valve_share = linear.scored;
  result.linear_model = result.valve_model = linear.model;
  double fitted = linear.fitted;
  constexpr double kNarrowest = 0.35, kWidest = 0.95, kStep = 1.07;
  for (double band = kNarrowest; band < kWidest; band *= kStep) {
    for (const double jump : kJumps) {
      for (const double direction : {-1.0, 1.0}) {
        const double stickband = band * travel;
        const Valve valve{kTravelLaw, stickband, jump * stickband, direction};
        fitted = try_valve(pv_means, op_means, valve, fitted, result);
      }
    }
  }
  return result;
}

SimulatedTravel simulate_travel(const SlowTravel& travel, std::span<const double> op) {
  const std::vector<double> means = means_of(op);
  const bool sticks = travel.valve.stickband_percent > 0.0;
  const std::vector<double> flow = sticks ? behind(travel.valve, means) : means;
  return {output_of(travel.linear_model, means, travel.level),
          output_of(travel.valve_model, flow, travel.level)};
}

}  // namespace loopscope::core::model
