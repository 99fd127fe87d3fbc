#include "core/model/response/noise_model.hpp"

#include <cmath>
#include <limits>

#include "core/model/vectors/number_pair.hpp"
#include "core/model/vectors/recursion-inl.hpp"

namespace loopscope::core::model {
namespace {

using Coefficients = std::array<double, kMostNoiseOrder>;

/// All zeros of 1 + c1 z^-1 + ... within the circle of that radius (Schur and Cohn's recursion).
bool within(const Coefficients& zeros, double radius) {
  Coefficients c{};
  double power = 1.0;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = zeros[i] / (power *= radius);
  for (std::size_t order = c.size(); order > 0; --order) {
    const double reflection = c[order - 1];
    if (std::abs(reflection) >= 1.0) return false;
    Coefficients lower{};
    for (std::size_t i = 0; i + 1 < order; ++i) {
      lower[i] = (c[i] - reflection * c[order - 2 - i]) / (1.0 - reflection * reflection);
    }
    c = lower;
  }
  return true;
}

/// y(k) = x(k) + sum a x(k-i) - sum c y(k-i), at rest at the first value. Number is double or
/// NumberPair; x(k) is read before y(k) is written.
template <typename Number, typename Read, typename Write>
void whiten_signal(const NoiseModel& noise, std::size_t count, Read read, Write write) {
  if (count == 0) return;
  const Coefficients a = autoregression(noise);
  const Coefficients& c = noise.zeros;
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

}  // namespace

Coefficients autoregression(const NoiseModel& noise) {
  const auto& m = noise.poles;
  return {-(m[0] + m[1] + m[2]), m[0] * m[1] + m[0] * m[2] + m[1] * m[2], -m[0] * m[1] * m[2]};
}

NoiseModel extended(const NoiseModel& noise, double pole, double zero) {
  NoiseModel result = noise;
  if (noise.order == kMostNoiseOrder) return result;
  result.poles[result.order++] = pole;
  result.zeros = {noise.zeros[0] - zero, noise.zeros[1] - zero * noise.zeros[0],
                  noise.zeros[2] - zero * noise.zeros[1]};
  return result;
}

void make_invertible(NoiseModel& noise) {
  constexpr double kOutermost = 0.985;
  constexpr double kShrink = 0.97;
  while (!within(noise.zeros, kOutermost)) {
    double power = 1.0;
    for (double& zero : noise.zeros) zero *= (power *= kShrink);
  }
}

double whitened_level(const NoiseModel& noise) {
  const Coefficients a = autoregression(noise);
  double above = 1.0, below = 1.0;
  for (std::size_t i = 0; i < kMostNoiseOrder; ++i) {
    above += a[i];
    below += noise.zeros[i];
  }
  return above / below;
}

std::size_t whitening_memory(const NoiseModel& noise) {
  // Zeros that coincide remember some thousand times more than one of them.
  constexpr double kForgotten = 1e-20;
  for (const double radius : {0.5, 0.7, 0.8, 0.9, 0.95}) {
    if (!within(noise.zeros, radius)) continue;
    const double samples = std::log(kForgotten) / std::log(radius);
    return static_cast<std::size_t>(samples) + noise.order;
  }
  return std::numeric_limits<std::size_t>::max();
}

void whiten(const NoiseModel& noise, std::span<const double> v, std::span<double> w) {
  whiten_signal<double>(
      noise, v.size(), [&](std::size_t k) { return v[k]; },
      [&](std::size_t k, double value) { w[k] = value; });
}

void whiten(const NoiseModel& noise, std::array<std::span<const double>, 2> v,
            std::array<std::span<double>, 2> w) {
  whiten_signal<NumberPair>(
      noise, v[0].size(),
      [&](std::size_t k) {
        return NumberPair{v[0][k], v[1][k]};
      },
      [&](std::size_t k, NumberPair value) {
        w[0][k] = value[0];
        w[1][k] = value[1];
      });
}

}  // namespace loopscope::core::model
