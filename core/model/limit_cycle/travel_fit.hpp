#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/model/limit_cycle/kernels/travel_kernel.hpp"

namespace loopscope::core::model {

/// pv as a constant, a trend over the record and a lag of the flow, by means.
struct TravelModel {
  double pole = 0.0;                             ///< of the lag, from mean to mean, 0 to 0.99
  std::size_t delay = 0;                         ///< means
  std::array<double, 3> weights{0.0, 0.0, 0.0};  ///< pv units, of the flow pv units per %
};

/// What a model explains of pv's variance: up to 1, below 0 where the mean does better.
struct TravelShare {
  double fitted = -1.0;  ///< on the blocks of means that are fitted
  double scored = 0.0;   ///< on those held out
  TravelModel model;
};

/// The constant, the trend and the lagged flow at one mean, in the order of the weights.
using TravelRow = std::array<double, 3>;
[[nodiscard]] std::vector<TravelRow> travel_rows(const std::vector<double>& flow, double pole,
                                                 std::size_t delay);

/// Up to eight flows through every lag, and what fits of one pv ask of them.
struct LaggedFlows {
  std::array<std::vector<EightNumbers>, kTravelPoles.size()> lagged;  ///< less their first values
  std::array<std::array<TravelSums, kTravelDelays.size()>, kTravelPoles.size()> sums;
};

/// Fits of one pv by any flow, for every lag and delay; blocks of six means are fitted and scored
/// by turns. What does not depend on the flow is summed once, and every sum runs in the record's
/// order.
class TravelFit {
 public:
  /// `pv`: the means, all finite; has to outlive this.
  explicit TravelFit(const std::vector<double>& pv);

  /// `flows`: as many as pv has means, at least one.
  [[nodiscard]] LaggedFlows lag(std::span<const EightNumbers> flows) const;
  /// The best of one of the flows on the blocks that are fitted; its `fitted` is `to_beat` and
  /// nothing else of it means anything where none is better than that.
  [[nodiscard]] TravelShare best(const LaggedFlows& flows, std::size_t place,
                                 double to_beat = -1.0) const;

 private:
  enum Kind : std::size_t { kFitted, kScored };
  /// One flow through one lag, and so much later.
  struct Lagged {
    std::span<const EightNumbers> flows;
    std::size_t place = 0;
    std::size_t delay = 0;
    [[nodiscard]] double operator[](std::size_t k) const {
      return flows[k < delay ? 0 : k - delay][place];
    }
  };

  /// Replaces `best` if it is better.
  void try_lag(const Lagged& lagged, const TravelSums& sums, double pole, TravelShare& best) const;
  [[nodiscard]] bool cannot_beat(const TravelSums& sums, std::size_t place, double fitted) const;
  [[nodiscard]] double explained(const Lagged& lagged, const std::array<double, 3>& weights,
                                 Kind kind) const;

  const std::vector<double>& pv_;
  std::vector<double> trend_;
  std::array<std::vector<Range>, 2> blocks_;  ///< of means, by kind
  /// Over the blocks that are fitted: the constant and the trend with themselves and with pv.
  double count_ = 0.0, trend_sum_ = 0.0, trend_square_ = 0.0;
  double pv_sum_ = 0.0, pv_square_ = 0.0, pv_trend_ = 0.0;
  /// The same without the constant: of the trend, and of the trend with pv; and what both leave of
  /// pv's squares.
  double trend_mean_ = 0.0, trend_variation_ = 0.0, pv_per_trend_ = 0.0, pv_left_ = 0.0;
  std::array<double, 2> variance_{};  ///< times the number of means, by kind
};

}  // namespace loopscope::core::model
