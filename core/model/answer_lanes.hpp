#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/model/noise_model.hpp"
#include "core/model/process_shape.hpp"
#include "core/model/valve_lanes.hpp"

namespace loopscope::core::model {

/// Signals side by side through a process and the whitening, a stretch of samples at a time: what
/// respond() and whiten() do one after the other to one signal, in an order that keeps few digits
/// from getting lost: the whitening's zeros come before the process's slow lag.
///
/// Number is NumberPair or ShortNumbers, and there are `count` of them; two of them hide what one
/// waits for.
template <typename Number, std::size_t count>
class AnswerLanes {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = std::array<Number, count>;

  /// `first`: the signals' first values, which they had before the record too. The dead time is the
  /// caller's: as many times the first value before the signals.
  AnswerLanes(const ProcessShape& shape, const NoiseModel& noise, const Numbers& first)
      : shape_(shape), order_(noise.order) {
    const std::array<double, kMostNoiseOrder> a = autoregression(noise);
    const double lags = (1.0 - shape.second_pole) * (shape.integrating ? 1.0 : 1.0 - shape.pole);
    const double level = 1.0 + a[0] + a[1] + a[2];
    front_ = static_cast<Element>(lags);
    for (std::size_t i = 0; i < kMostNoiseOrder; ++i) {
      moving_[i] = static_cast<Element>(lags * a[i]);
      zeros_[i] = static_cast<Element>(noise.zeros[i]);
    }
    pole_ = static_cast<Element>(shape.integrating ? 1.0 : shape.pole);
    second_pole_ = static_cast<Element>(shape.second_pole);
    const auto at_rest = [&](double factor) {
      Numbers rest;
      for (std::size_t i = 0; i < count; ++i) rest[i] = first[i] * static_cast<Element>(factor);
      return rest;
    };
    second_lag_ = at_rest(1.0 / (1.0 - shape.second_pole));
    // An integrator begins at the first value, and sums up what comes after it.
    inputs_.fill(at_rest(shape.integrating ? 0.0 : 1.0 / (1.0 - shape.second_pole)));
    lag_ = at_rest(level);
    outputs_.fill(at_rest(whitened_level(noise)));
  }

  /// The next `samples` of the signals, in place.
  void run(Numbers* signals, std::size_t samples) {
    if (samples == 0) return;
    if (shape_.second_pole != 0.0) lag(second_pole_, second_lag_, signals, samples);
    if (shape_.integrating && !begun_) signals[0] = Numbers{};
    begun_ = true;
    if (order_ == 1) return whiten<1>(signals, samples);
    if (order_ == 2) return whiten<2>(signals, samples);
    whiten<3>(signals, samples);
  }

 private:
  using Memory = std::array<Numbers, kMostNoiseOrder>;  ///< the newest first

  static void lag(Element pole, Numbers& state, Numbers* signals, std::size_t samples) {
    Numbers y = state;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) signals[k][i] = y[i] = signals[k][i] + pole * y[i];
    }
    state = y;
  }

  template <std::size_t order>
  void whiten(Numbers* signals, std::size_t samples) {
    move<order>(signals, samples);
    if (pole_ != 0) lag(pole_, lag_, signals, samples);
    settle<order>(signals, samples);
  }

  /// The zeros of the whitening, and the gain of the lags.
  template <std::size_t order>
  void move(Numbers* signals, std::size_t samples) {
    Memory x = inputs_;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        const Number now = signals[k][i];
        Number sum = front_ * now;
        for (std::size_t j = 0; j < order; ++j) sum += moving_[j] * x[j][i];
        for (std::size_t j = order; j-- > 1;) x[j][i] = x[j - 1][i];
        x[0][i] = now;
        signals[k][i] = sum;
      }
    }
    inputs_ = x;
  }

  /// The poles of the whitening.
  template <std::size_t order>
  void settle(Numbers* signals, std::size_t samples) {
    Memory y = outputs_;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        Number sum = signals[k][i];
        // The newest last: what waits for it is one product and one difference.
        for (std::size_t j = order; j-- > 0;) sum -= zeros_[j] * y[j][i];
        for (std::size_t j = order; j-- > 1;) y[j][i] = y[j - 1][i];
        signals[k][i] = y[0][i] = sum;
      }
    }
    outputs_ = y;
  }

  const ProcessShape& shape_;
  std::size_t order_;
  Element front_, pole_, second_pole_;
  std::array<Element, kMostNoiseOrder> moving_{}, zeros_{};
  Numbers second_lag_, lag_;
  Memory inputs_{}, outputs_{};
  bool begun_ = false;
};

}  // namespace loopscope::core::model
