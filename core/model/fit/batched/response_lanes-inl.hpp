// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_RESPONSE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_RESPONSE_LANES_INL
#undef LOOPSCOPE_MODEL_RESPONSE_LANES_INL
#else
#define LOOPSCOPE_MODEL_RESPONSE_LANES_INL
#endif

#include <array>
#include <cstddef>
#include <hwy/highway.h>

#include "core/model/response/noise_model.hpp"
#include "core/model/response/process_shape.hpp"
#include "core/model/valve_law/valve_lanes-inl.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Poles of processes side by side, that of an integrator 1.
template <typename Number, std::size_t count>
struct PoleLanes {
  NumberRow<Number, count> pole{}, second_pole{};
  std::array<double, count * kElements<Number>> gain{};  ///< (1 - pole) (1 - second pole), or that
                                                         ///< of the second
  bool integrating = false;                              ///< all of them
  bool any_pole = false, any_second_pole = false;

  void put(std::size_t lane, const ProcessShape& shape) {
    const std::size_t v = lane / kElements<Number>, i = lane % kElements<Number>;
    const double first = shape.integrating ? 1.0 : shape.pole;
    put_element(pole[v], i, first);
    put_element(second_pole[v], i, shape.second_pole);
    gain[lane] = (1.0 - shape.second_pole) * (shape.integrating ? 1.0 : 1.0 - shape.pole);
    integrating = shape.integrating;
    any_pole = any_pole || first != 0.0;
    any_second_pole = any_second_pole || shape.second_pole != 0.0;
  }
};

/// Signals side by side through a process each and one whitening, a stretch of samples at a time:
/// what respond() and whiten() do one after the other to one signal, but for the gain of the poles,
/// in an order that keeps few digits from getting lost: the whitening's zeros come before the
/// process's slow lag.
///
/// Number is NumberPair or ShortNumbers, and there are `count` of them; two of them hide what one
/// waits for.
template <typename Number, std::size_t count>
class AnswerLanes {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, count>;

  /// `first`: the signals' first values, which they had before the record too. The dead time is the
  /// caller's: as many times the first value before the signals.
  AnswerLanes(const PoleLanes<Number, count>& poles, const NoiseModel& noise, const Numbers& first)
      : poles_(poles), order_(noise.order) {
    const std::array<double, kMostNoiseOrder> a = autoregression(noise);
    for (std::size_t i = 0; i < kMostNoiseOrder; ++i) {
      moving_[i] = static_cast<Element>(a[i]);
      zeros_[i] = static_cast<Element>(noise.zeros[i]);
    }
    const auto level = static_cast<Element>(1.0 + a[0] + a[1] + a[2]);
    const auto whitened = static_cast<Element>(whitened_level(noise));
    for (std::size_t i = 0; i < count; ++i) {
      const Number lagged = first[i] / (Element{1} - poles.second_pole[i]);
      const Number rest = poles.integrating ? lagged : lagged / (Element{1} - poles.pole[i]);
      second_lag_[i] = lagged;
      // An integrator begins at the first value, and sums up what comes after it.
      for (Numbers& input : inputs_) input[i] = poles.integrating ? Number{} : lagged;
      lag_[i] = rest * level;
      for (Numbers& output : outputs_) output[i] = rest * whitened;
    }
  }

  /// The next `samples` of the signals, in place.
  void run(Numbers* signals, std::size_t samples) {
    if (samples == 0) return;
    if (poles_.any_second_pole) lag(poles_.second_pole, second_lag_, signals, samples);
    if (poles_.integrating && !begun_) signals[0] = Numbers{};
    begun_ = true;
    if (order_ == 1) return whiten<1>(signals, samples);
    if (order_ == 2) return whiten<2>(signals, samples);
    whiten<3>(signals, samples);
  }

 private:
  using Memory = std::array<Numbers, kMostNoiseOrder>;  ///< the newest first

  static void lag(const Numbers& poles, Numbers& state, Numbers* signals, std::size_t samples) {
    const Numbers p = poles;
    Numbers y = state;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) signals[k][i] = y[i] = signals[k][i] + p[i] * y[i];
    }
    state = y;
  }

  template <std::size_t order>
  void whiten(Numbers* signals, std::size_t samples) {
    move<order>(signals, samples);
    if (poles_.any_pole) lag(poles_.pole, lag_, signals, samples);
    settle<order>(signals, samples);
  }

  /// The zeros of the whitening.
  template <std::size_t order>
  void move(Numbers* signals, std::size_t samples) {
    Memory x = inputs_;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        const Number now = signals[k][i];
        Number sum = now;
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

  const PoleLanes<Number, count>& poles_;
  std::size_t order_;
  std::array<Element, kMostNoiseOrder> moving_{}, zeros_{};
  Numbers second_lag_, lag_;
  Memory inputs_{}, outputs_{};
  bool begun_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_RESPONSE_LANES_INL
