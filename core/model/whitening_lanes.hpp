#pragma once

#include "core/model/lane_basis.hpp"
#include "core/model/recursion.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// y(k) = x(k) + sum a x(k-i) - sum c y(k-i), at rest at the first value. Number is double or
/// some of them; x(k) is read before y(k) is written.
template <typename Number, typename Read, typename Write>
void whiten_signal(const NoiseModel& noise, std::size_t count, Read read, Write write) {
  if (count == 0) return;
  const auto a = autoregression(noise);
  const auto& c = noise.zeros;
  Number x1 = read(0);
  const Number rest = x1 * whitened_level(noise);
  if (noise.order == 1) {
    const auto moves = [&](std::size_t k) {
      const Number value = read(k);
      const Number move = value + a[0] * x1;
      x1 = value;
      return move;
    };
    run_recursion(Number{} - c[0], rest, count, moves, write);
    return;
  }
  Number x2 = x1, x3 = x1, y1 = rest, y2 = rest, y3 = rest;
  for (std::size_t k = 0; k < count; ++k) {
    const Number x = read(k);
    // The newest y last: what waits for it is one product and one difference.
    const Number known = x + a[0] * x1 + a[1] * x2 + a[2] * x3 - c[1] * y2 - c[2] * y3;
    const Number y = known - c[0] * y1;
    write(k, y);
    x3 = x2;
    x2 = x1;
    x1 = x;
    y3 = y2;
    y2 = y1;
    y1 = y;
  }
}

/// As many signals as a Number has, of that length.
template <typename Number>
void whiten_abreast(const NoiseModel& noise, const Signal* signals, double* const* whitened,
                    std::size_t samples) {
  whiten_signal<Number>(
      noise, samples,
      [&](std::size_t k) {
        Number value{};
        for (std::size_t i = 0; i < kElements<Number>; ++i) value[i] = signals[i][k];
        return value;
      },
      [&](std::size_t k, const Number& value) {
        for (std::size_t i = 0; i < kElements<Number>; ++i) whitened[i][k] = value[i];
      });
}

/// Four signals of that length, as many at a time as a Number has.
template <typename Number>
void whiten_by_fours(const NoiseModel& noise, const Signal* signals, double* const* whitened,
                     std::size_t samples) {
  for (std::size_t i = 0; i < 4; i += kElements<Number>)
    whiten_abreast<Number>(noise, signals + i, whitened + i, samples);
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
