#include "core/model/limit_cycle/slow_travel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kFewestMeans = 40;
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

std::vector<double> behind(const Valve& valve, const std::vector<double>& op) {
  std::vector<double> flow(op.size());
  run_valve(valve, op, flow);
  return flow;
}

std::vector<double> output_of(const TravelModel& model, const std::vector<double>& flow,
                              double level) {
  const auto& w = model.weights;
  std::vector<double> pv;
  for (const TravelRow& row : travel_rows(flow, model.pole, model.delay))
    pv.push_back(level + (row[0] * w[0] + row[1] * w[1] + row[2] * w[2]));
  return pv;
}

/// Of one band: with every jump; those of the first half have moved down last.
std::array<Valve, kSideBySide> valves_of(double stickband) {
  static_assert(2 * kJumps.size() == kSideBySide);
  std::array<Valve, kSideBySide> valves;
  for (std::size_t i = 0; i < kJumps.size(); ++i) {
    valves[i] = {kTravelLaw, stickband, kJumps[i] * stickband, -1.0};
    valves[kJumps.size() + i] = {kTravelLaw, stickband, kJumps[i] * stickband, 1.0};
  }
  return valves;
}

/// `to_beat`: the best share on the fitted blocks so far, by which valves are ranked.
void try_valves(const TravelFit& fit, const std::vector<double>& op, double stickband,
                double& to_beat, SlowTravel& best) {
  const std::array<Valve, kSideBySide> valves = valves_of(stickband);
  std::vector<EightNumbers> flows(op.size());
  run_valves(valves, op, flows);
  const LaggedFlows lagged = fit.lag(flows);
  for (std::size_t i = 0; i < kJumps.size(); ++i) {
    for (const std::size_t place : {i, kJumps.size() + i}) {
      const TravelShare share = fit.best(lagged, place, to_beat);
      if (share.fitted <= to_beat) continue;
      to_beat = share.fitted;
      best.valve_share = share.scored;
      best.valve_model = share.model;
      best.valve = valves[place];
    }
  }
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
  const TravelFit fit(pv_means);
  const TravelShare linear = fit.best(fit.lag(eight_times(op_means)), 0);
  result.linear_share = result.valve_share = linear.scored;
  result.linear_model = result.valve_model = linear.model;
  double fitted = linear.fitted;
  constexpr double kNarrowest = 0.35, kWidest = 0.95, kStep = 1.07;
  for (double band = kNarrowest; band < kWidest; band *= kStep)
    try_valves(fit, op_means, band * travel, fitted, result);
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
