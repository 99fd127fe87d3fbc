#pragma once

#include <array>
#include <cstddef>
#include <vector>

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

/// Fits of one pv by any flow, for every lag and delay; blocks of six means are fitted and scored
/// by turns. What does not depend on the flow is summed once, and every sum runs in the record's
/// order.
class TravelFit {
 public:
  /// `pv`: the means, all finite; has to outlive this.
  explicit TravelFit(const std::vector<double>& pv);

  /// The best on the blocks that are fitted; its `fitted` is `to_beat` and nothing else of it means
  /// anything where none is better than that. `flow` has the length of pv.
  [[nodiscard]] TravelShare best(const std::vector<double>& flow, double to_beat = -1.0) const;

 private:
  struct Lags;
  struct LagSums;
  enum Kind : std::size_t { kFitted, kScored };

  [[nodiscard]] LagSums sums_of(const std::vector<Lags>& lagged, std::size_t delay) const;
  /// Replaces `best` if it is better.
  void try_lag(const std::vector<Lags>& lagged, const LagSums& sums, std::size_t pole,
               std::size_t delay, TravelShare& best) const;
  [[nodiscard]] double explained(const std::vector<Lags>& lagged, std::size_t pole,
                                 std::size_t delay, const std::array<double, 3>& weights,
                                 Kind kind) const;

  const std::vector<double>& pv_;
  std::vector<double> trend_;
  /// Over the blocks that are fitted: the constant and the trend with themselves and with pv.
  double count_ = 0.0, trend_sum_ = 0.0, trend_square_ = 0.0;
  double pv_sum_ = 0.0, pv_square_ = 0.0, pv_trend_ = 0.0;
  std::array<double, 2> variance_{};  ///< times the number of means, by kind
};

}  // namespace loopscope::core::model
