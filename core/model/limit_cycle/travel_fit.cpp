#include "core/model/limit_cycle/travel_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace loopscope::core::model {
namespace {

/// Lags of up to a hundred means, delays of up to three: a lag that the linear rival lacks looks
/// like a valve that comes late.
constexpr std::array kTravelPoles = {0.0, 0.6, 0.85, 0.95, 0.99};
constexpr std::array<std::size_t, 3> kTravelDelays = {0, 1, 3};

/// Of sums of some thousand products, relative to their sizes, with room.
constexpr double kSumRounding = 1e-11;

constexpr std::size_t kBlock = 6;
/// Calls `use(k)` for every mean of the blocks that are fitted (0), or of the others (1).
template <typename Use>
void each_of(std::size_t kind, std::size_t size, Use use) {
  for (std::size_t from = kind * kBlock; from < size; from += 2 * kBlock) {
    const std::size_t to = std::min(from + kBlock, size);
    for (std::size_t k = from; k < to; ++k) use(k);
  }
}

double trend_at(std::size_t k, std::size_t size) {
  return static_cast<double>(k) / static_cast<double>(size) - 0.5;
}

}  // namespace

/// One lane for each lag, and one to spare: whole vectors of a processor.
constexpr int kLanes = static_cast<int>(kTravelPoles.size()) + 1;

/// The flow through each lag, less its first value.
struct TravelFit::Lags : Eigen::Array<double, kLanes, 1> {
  using Array::Array, Array::operator=;
};

/// Of each lag, over the blocks that are fitted.
struct TravelFit::LagSums {
  Lags sum = Lags::Zero(), with_trend = Lags::Zero(), square = Lags::Zero(), with_pv = Lags::Zero();
};

std::vector<TravelRow> travel_rows(const std::vector<double>& flow, double pole,
                                   std::size_t delay) {
  std::vector<TravelRow> rows(flow.size());
  double state = flow.front();
  for (std::size_t k = 0; k < flow.size(); ++k) {
    state += (1.0 - pole) * (flow[k < delay ? 0 : k - delay] - state);
    rows[k] = {1.0, trend_at(k, flow.size()), state - flow.front()};
  }
  return rows;
}

TravelFit::TravelFit(const std::vector<double>& pv) : pv_(pv), trend_(pv.size()) {
  for (std::size_t k = 0; k < pv.size(); ++k) trend_[k] = trend_at(k, pv.size());
  for (const Kind kind : {kFitted, kScored}) {
    double sum = 0.0, square = 0.0, count = 0.0;
    each_of(kind, pv.size(), [&](std::size_t k) {
      sum += pv[k];
      square += pv[k] * pv[k];
      count += 1.0;
    });
    if (kind == kFitted) {
      pv_sum_ = sum;
      pv_square_ = square;
    }
    variance_[kind] = square - sum * sum / count;
  }
  each_of(kFitted, pv.size(), [&](std::size_t k) {
    count_ += 1.0;
    trend_sum_ += trend_[k];
    trend_square_ += trend_[k] * trend_[k];
    pv_trend_ += trend_[k] * pv[k];
  });
}

TravelShare TravelFit::best(const std::vector<double>& flow, double to_beat) const {
  // Every lag rests at the first value for as long as a delay holds it: the record of a delay is
  // the one without, later.
  std::vector<Lags> lagged(flow.size());
  Lags state = Lags::Constant(flow.front()), share = Lags::Zero();
  for (std::size_t pole = 0; pole < kTravelPoles.size(); ++pole)
    share[static_cast<Eigen::Index>(pole)] = 1.0 - kTravelPoles[pole];
  for (std::size_t k = 0; k < flow.size(); ++k) {
    state += share * (flow[k] - state);
    lagged[k] = state - flow.front();
  }
  std::array<LagSums, kTravelDelays.size()> sums;
  for (std::size_t d = 0; d < kTravelDelays.size(); ++d)
    sums[d] = sums_of(lagged, kTravelDelays[d]);
  TravelShare best;
  best.fitted = to_beat;
  for (std::size_t pole = 0; pole < kTravelPoles.size(); ++pole) {
    for (std::size_t d = 0; d < kTravelDelays.size(); ++d) {
      try_lag(lagged, sums[d], pole, kTravelDelays[d], best);
    }
  }
  return best;
}

TravelFit::LagSums TravelFit::sums_of(const std::vector<Lags>& lagged, std::size_t delay) const {
  LagSums sums;
  each_of(kFitted, pv_.size(), [&](std::size_t k) {
    const Lags& flow = lagged[k < delay ? 0 : k - delay];
    sums.sum += flow;
    sums.with_trend += trend_[k] * flow;
    sums.square += flow * flow;
    sums.with_pv += flow * pv_[k];
  });
  return sums;
}

void TravelFit::try_lag(const std::vector<Lags>& lagged, const LagSums& sums, std::size_t pole,
                        std::size_t delay, TravelShare& best) const {
  const auto lane = static_cast<Eigen::Index>(pole);
  const double sum = sums.sum[lane], with_trend = sums.with_trend[lane];
  const double square = sums.square[lane];
  if (square <= 0.0) return;
  const Eigen::Matrix3d normal{{count_, trend_sum_, sum},
                               {trend_sum_, trend_square_, with_trend},
                               {sum, with_trend, square}};
  const Eigen::Vector3d right{pv_sum_, pv_trend_, sums.with_pv[lane]};
  const Eigen::Vector3d solved = normal.ldlt().solve(right);
  const double sizes = pv_square_ + 2.0 * solved.cwiseAbs().dot(right.cwiseAbs()) +
                       solved.cwiseAbs().dot(normal.cwiseAbs() * solved.cwiseAbs());
  const double left = pv_square_ - 2.0 * solved.dot(right) + solved.dot(normal * solved);
  const bool varies = variance_[kFitted] > 0.0;
  if (varies && left - kSumRounding * sizes > (1.0 - best.fitted) * variance_[kFitted]) return;
  const std::array weights{solved[0], solved[1], solved[2]};
  const double fitted = explained(lagged, pole, delay, weights, kFitted);
  if (!(fitted > best.fitted)) return;
  best = {fitted,
          explained(lagged, pole, delay, weights, kScored),
          {kTravelPoles[pole], delay, weights}};
}

/// One less the mean square that `weights` leave by the variance, on the blocks of one kind.
double TravelFit::explained(const std::vector<Lags>& lagged, std::size_t pole, std::size_t delay,
                            const std::array<double, 3>& weights, Kind kind) const {
  if (!(variance_[kind] > 0.0)) return 0.0;
  const auto lane = static_cast<Eigen::Index>(pole);
  double left = 0.0;
  each_of(kind, pv_.size(), [&](std::size_t k) {
    const double flow = lagged[k < delay ? 0 : k - delay][lane];
    const double rest = pv_[k] - (weights[0] + (trend_[k] * weights[1] + flow * weights[2]));
    left += rest * rest;
  });
  return 1.0 - left / variance_[kind];
}

}  // namespace loopscope::core::model
