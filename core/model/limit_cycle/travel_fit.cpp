#include "core/model/limit_cycle/travel_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace loopscope::core::model {
namespace {

/// Of sums of some thousand products, relative to their sizes, with room.
constexpr double kSumRounding = 1e-11;

constexpr std::size_t kBlock = 6;
/// Those that are fitted, and the others.
std::array<std::vector<Range>, 2> blocks_of(std::size_t size) {
  std::array<std::vector<Range>, 2> blocks;
  for (std::size_t from = 0; from < size; from += kBlock)
    blocks[from / kBlock % 2].push_back({from, std::min(from + kBlock, size)});
  return blocks;
}

/// Calls `use(k)` for every mean of them.
template <typename Use>
void each_of(const std::vector<Range>& blocks, Use use) {
  for (const Range& block : blocks) {
    for (std::size_t k = block.first; k < block.end; ++k) use(k);
  }
}

double trend_at(std::size_t k, std::size_t size) {
  return static_cast<double>(k) / static_cast<double>(size) - 0.5;
}

}  // namespace

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

TravelFit::TravelFit(const std::vector<double>& pv)
    : pv_(pv), trend_(pv.size()), blocks_(blocks_of(pv.size())) {
  for (std::size_t k = 0; k < pv.size(); ++k) trend_[k] = trend_at(k, pv.size());
  for (const Kind kind : {kFitted, kScored}) {
    double sum = 0.0, square = 0.0, count = 0.0;
    each_of(blocks_[kind], [&](std::size_t k) {
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
  each_of(blocks_[kFitted], [&](std::size_t k) {
    count_ += 1.0;
    trend_sum_ += trend_[k];
    trend_square_ += trend_[k] * trend_[k];
    pv_trend_ += trend_[k] * pv[k];
  });
  trend_mean_ = trend_sum_ / count_;
  trend_variation_ = trend_square_ - trend_sum_ * trend_mean_;
  pv_per_trend_ = pv_trend_ - trend_mean_ * pv_sum_;
  pv_left_ =
      pv_square_ - pv_sum_ * pv_sum_ / count_ - pv_per_trend_ * pv_per_trend_ / trend_variation_;
}

LaggedFlows TravelFit::lag(std::span<const EightNumbers> flows) const {
  const TravelKernel& kernel = best_travel_kernel();
  LaggedFlows result;
  std::array<EightNumbers*, kTravelPoles.size()> firsts{};
  for (std::size_t pole = 0; pole < kTravelPoles.size(); ++pole) {
    result.lagged[pole].resize(flows.size());
    firsts[pole] = result.lagged[pole].data();
  }
  kernel.lag(flows, firsts.data());
  for (std::size_t pole = 0; pole < kTravelPoles.size(); ++pole) {
    for (std::size_t d = 0; d < kTravelDelays.size(); ++d)
      result.sums[pole][d] =
          kernel.sum(firsts[pole], kTravelDelays[d], blocks_[kFitted], trend_.data(), pv_.data());
  }
  return result;
}

TravelShare TravelFit::best(const LaggedFlows& flows, std::size_t place, double to_beat) const {
  TravelShare best;
  best.fitted = to_beat;
  for (std::size_t pole = 0; pole < kTravelPoles.size(); ++pole) {
    for (std::size_t d = 0; d < kTravelDelays.size(); ++d) {
      const Lagged lagged{flows.lagged[pole], place, kTravelDelays[d]};
      try_lag(lagged, flows.sums[pole][d], kTravelPoles[pole], best);
    }
  }
  return best;
}

void TravelFit::try_lag(const Lagged& lagged, const TravelSums& sums, double pole,
                        TravelShare& best) const {
  const std::size_t place = lagged.place;
  const double sum = sums.sum[place], with_trend = sums.with_trend[place];
  const double square = sums.square[place];
  if (square <= 0.0 || cannot_beat(sums, place, best.fitted)) return;
  const Eigen::Matrix3d normal{{count_, trend_sum_, sum},
                               {trend_sum_, trend_square_, with_trend},
                               {sum, with_trend, square}};
  const Eigen::Vector3d right{pv_sum_, pv_trend_, sums.with_pv[place]};
  const Eigen::Vector3d solved = normal.ldlt().solve(right);
  const double sizes = pv_square_ + 2.0 * solved.cwiseAbs().dot(right.cwiseAbs()) +
                       solved.cwiseAbs().dot(normal.cwiseAbs() * solved.cwiseAbs());
  const double left = pv_square_ - 2.0 * solved.dot(right) + solved.dot(normal * solved);
  const bool varies = variance_[kFitted] > 0.0;
  if (varies && left - kSumRounding * sizes > (1.0 - best.fitted) * variance_[kFitted]) return;
  const std::array weights{solved[0], solved[1], solved[2]};
  const double fitted = explained(lagged, weights, kFitted);
  if (!(fitted > best.fitted)) return;
  best = {fitted, explained(lagged, weights, kScored), {pole, lagged.delay, weights}};
}

/// Whether no weights at all bring the share above `fitted`: by the squares left of pv once the
/// constant and the trend have been taken out of pv and flow, where enough is left of the flow.
bool TravelFit::cannot_beat(const TravelSums& sums, std::size_t place, double fitted) const {
  // Of the flow's squares; with more, what follows is good to 1e-9 of pv's.
  constexpr double kEnoughLeft = 1e-5;
  constexpr double kRoom = 1e-6;
  // Products of smaller squares vanish.
  constexpr double kSmallestSquare = 1e-100;
  const double sum = sums.sum[place], square = sums.square[place];
  const double per_trend = sums.with_trend[place] - trend_mean_ * sum;
  const double flow_left = square - sum * sum / count_ - per_trend * per_trend / trend_variation_;
  if (!(flow_left > kEnoughLeft * square) || !(variance_[kFitted] > 0.0)) return false;
  if (!(std::min(square, pv_square_) > kSmallestSquare)) return false;
  const double with_pv =
      sums.with_pv[place] - sum * pv_sum_ / count_ - per_trend * pv_per_trend_ / trend_variation_;
  const double left = pv_left_ - with_pv * with_pv / flow_left;
  return left - kRoom * pv_square_ > (1.0 - fitted) * variance_[kFitted];
}

/// One less the mean square that `weights` leave by the variance, on the blocks of one kind.
double TravelFit::explained(const Lagged& lagged, const std::array<double, 3>& weights,
                            Kind kind) const {
  if (!(variance_[kind] > 0.0)) return 0.0;
  double left = 0.0;
  each_of(blocks_[kind], [&](std::size_t k) {
    const double rest = pv_[k] - (weights[0] + (trend_[k] * weights[1] + lagged[k] * weights[2]));
    left += rest * rest;
  });
  return 1.0 - left / variance_[kind];
}

}  // namespace loopscope::core::model
