// Sums along records: record_sums.hpp says what is summed.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_RECORD_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_RECORD_SUMS_INL
#undef LOOPSCOPE_HOS_RECORD_SUMS_INL
#else
#define LOOPSCOPE_HOS_RECORD_SUMS_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <hwy/highway.h>
#include <limits>
#include <numbers>
#include <span>

#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/record_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

HWY_INLINE Vector zero_unless(Vector value, Vector test, double limit) {
  return hn::IfThenElseZero(hn::Abs(test) <= broadcast(limit), value);
}

struct PowerLanes {
  Vector count{};
  Vector first{};
  Vector second{};
  Vector third{};
  Vector fourth{};
};

HWY_INLINE void add(PowerLanes& sums, Vector sample, const Centring& centring) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const Vector less_first = sample * broadcast(centring.factor) - broadcast(centring.first);
  const Vector y = zero_unless(less_first - broadcast(centring.centre), sample, kLargest);
  const Vector square = y * y;
  sums.count += zero_unless(broadcast(1.0), sample, kLargest);
  sums.first += y;
  sums.second += square;
  sums.third = multiply_add(square, y, sums.third);
  sums.fourth = multiply_add(square, square, sums.fourth);
}

PowerSums sum_powers(std::span<const double> signal, const Centring& centring) {
  PowerLanes even;
  PowerLanes odd;
  std::size_t n = 0;
  for (; n + 2 * kWidth <= signal.size(); n += 2 * kWidth) {
    add(even, load_anywhere(signal.data() + n), centring);
    add(odd, load_anywhere(signal.data() + n + kWidth), centring);
  }
  // What is left, followed by missing samples.
  alignas(kAlignment) double rest[2 * kWidth];
  std::fill_n(rest, 2 * kWidth, std::numeric_limits<double>::quiet_NaN());
  std::copy(signal.begin() + static_cast<std::ptrdiff_t>(n), signal.end(), rest);
  add(even, load(rest), centring);
  add(odd, load(rest + kWidth), centring);
  const Vectors<5> lanes{even.count + odd.count, even.first + odd.first, even.second + odd.second,
                         even.third + odd.third, even.fourth + odd.fourth};
  alignas(kAlignment) double sums[5 + kWidth];
  sum_lanes(lanes, sums);
  return {sums[0], sums[1], sums[2], sums[3], sums[4]};
}

/// A record in whole vectors, the last one followed by missing samples, and the places of its
/// samples, counted from its middle.
class PlacedSamples {
 public:
  HWY_INLINE explicit PlacedSamples(std::span<const double> signal) : signal_(signal) {
    alignas(kAlignment) double first[kWidth];
    for (std::size_t i = 0; i < kWidth; ++i) {
      first[i] = static_cast<double>(i) - (static_cast<double>(signal.size()) - 1.0) / 2.0;
    }
    place = load(first);
  }
  HWY_INLINE Vector at(std::size_t n) const {
    if (n + kWidth <= signal_.size()) return load_anywhere(signal_.data() + n);
    alignas(kAlignment) double rest[kWidth];
    std::fill_n(rest, kWidth, std::numeric_limits<double>::quiet_NaN());
    std::copy(signal_.begin() + static_cast<std::ptrdiff_t>(n), signal_.end(), rest);
    return load(rest);
  }
  HWY_INLINE void advance() { place += broadcast(static_cast<double>(kWidth)); }

  Vector place;

 private:
  std::span<const double> signal_;
};

TrendSums sum_trend(std::span<const double> signal, const Centring& centring) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Vectors<5> sums{};
  PlacedSamples samples(signal);
  for (std::size_t n = 0; n < signal.size(); n += kWidth, samples.advance()) {
    const Vector sample = samples.at(n);
    const Vector y = sample * broadcast(centring.factor) - broadcast(centring.first);
    const Vector value = zero_unless(y, sample, kLargest);
    const Vector place = zero_unless(samples.place, sample, kLargest);
    sums.at[0] += zero_unless(broadcast(1.0), sample, kLargest);
    sums.at[1] += place;
    sums.at[2] = multiply_add(place, place, sums.at[2]);
    sums.at[3] += value;
    sums.at[4] = multiply_add(place, value, sums.at[4]);
  }
  alignas(kAlignment) double totals[5 + kWidth];
  sum_lanes(sums, totals);
  return {totals[0], totals[1], totals[2], totals[3], totals[4]};
}

/// The turn that a raised cosine over `count` samples takes, carried on by multiplication: a cosine
/// for each of 4096 samples would take longer than their transform.
class TurnAlong {
 public:
  HWY_INLINE explicit TurnAlong(double count) {
    alignas(kAlignment) double cosine[kWidth];
    alignas(kAlignment) double sine[kWidth];
    const double step = 2.0 * std::numbers::pi / count;
    for (std::size_t i = 0; i < kWidth; ++i) {
      cosine[i] = std::cos((static_cast<double>(i) + 0.5) * step);
      sine[i] = std::sin((static_cast<double>(i) + 0.5) * step);
    }
    cosine_ = load(cosine);
    sine_ = load(sine);
    step_cosine_ = broadcast(std::cos(static_cast<double>(kWidth) * step));
    step_sine_ = broadcast(std::sin(static_cast<double>(kWidth) * step));
  }
  HWY_INLINE Vector cosine() const { return cosine_; }
  HWY_INLINE void advance() {
    const Vector before = cosine_;
    cosine_ = subtract_product(sine_, step_sine_, before * step_cosine_);
    sine_ = multiply_add(before, step_sine_, sine_ * step_cosine_);
  }

 private:
  Vector cosine_;
  Vector sine_;
  Vector step_cosine_;
  Vector step_sine_;
};

void taper_record(std::span<const double> signal, const Centring& centring, double* tapered) {
  PlacedSamples samples(signal);
  TurnAlong turn(static_cast<double>(signal.size()));
  for (std::size_t n = 0; n < signal.size(); n += kWidth, samples.advance(), turn.advance()) {
    const Vector sample = samples.at(n);
    const Vector y = sample * broadcast(centring.factor) - broadcast(centring.first);
    const Vector line =
        multiply_add(samples.place, broadcast(centring.slope), broadcast(centring.centre));
    const Vector weight = subtract_product(broadcast(0.5), turn.cosine(), broadcast(0.5));
    const Vector value =
        zero_unless((y - line) * weight, sample, std::numeric_limits<double>::max());
    if (n + kWidth <= signal.size()) {
      store_anywhere(tapered + n, value);
    } else {
      alignas(kAlignment) double rest[kWidth];
      store(rest, value);
      std::copy_n(rest, signal.size() - n, tapered + n);
    }
  }
}

HWY_INLINE PairSums pair_sums(Vector product, Vector power) {
  alignas(kAlignment) double sums[2 + kWidth];
  sum_lanes(Vectors<2>{product, power}, sums);
  return {sums[0], sums[1]};
}

/// Of the differences and the differences before them; those that miss a sample left out.
PairSums sum_differences(std::span<const double> signal) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Vector product = hn::Zero(Tag());
  Vector power = hn::Zero(Tag());
  std::size_t n = 2;
  for (; n + kWidth <= signal.size(); n += kWidth) {
    const double* const x = signal.data() + n;
    const Vector middle = load_anywhere(x - 1);
    const Vector now = load_anywhere(x) - middle;
    const Vector before = middle - load_anywhere(x - 2);
    const Vector both = now + before;
    product += zero_unless(now * before, both, kLargest);
    power += zero_unless(multiply_add(now, now, before * before), both, kLargest);
  }
  PairSums sums = pair_sums(product, power);
  for (; n < signal.size(); ++n) {
    const double now = signal[n] - signal[n - 1];
    const double before = signal[n - 1] - signal[n - 2];
    if (!std::isfinite(now + before)) continue;
    sums.product += now * before;
    sums.power += now * now + before * before;
  }
  return sums;
}

PairSums sum_pairs(const double* f, const double* b, std::size_t count) {
  Vector product[2] = {};
  Vector power[2] = {};
  std::size_t n = 0;
  for (; n + 2 * kWidth <= count; n += 2 * kWidth) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector forward = load_anywhere(f + n + i * kWidth);
      const Vector backward = load_anywhere(b + n + i * kWidth);
      product[i] = multiply_add(forward, backward, product[i]);
      power[i] = multiply_add(forward, forward, multiply_add(backward, backward, power[i]));
    }
  }
  PairSums sums = pair_sums(product[0] + product[1], power[0] + power[1]);
  for (; n < count; ++n) {
    sums.product += f[n] * b[n];
    sums.power += f[n] * f[n] + b[n] * b[n];
  }
  return sums;
}

/// f - k b to f, and b - k f to b.
void predict_each_other(double* f, double* b, std::size_t count, double k) {
  const Vector factor = broadcast(k);
  std::size_t n = 0;
  for (; n + kWidth <= count; n += kWidth) {
    const Vector forward = load_anywhere(f + n);
    const Vector backward = load_anywhere(b + n);
    store_anywhere(f + n, subtract_product(factor, backward, forward));
    store_anywhere(b + n, subtract_product(factor, forward, backward));
  }
  for (; n < count; ++n) {
    const double forward = f[n];
    f[n] = forward - k * b[n];
    b[n] = b[n] - k * forward;
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_RECORD_SUMS_INL
