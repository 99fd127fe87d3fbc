#include "core/model/noise_model.hpp"

#include <cmath>
#include <limits>

#include "core/model/lane_kernel.hpp"
#include "core/model/whitening_lanes.hpp"

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
  const std::array signals{v[0].data(), v[1].data()};
  const std::array whitened{w[0].data(), w[1].data()};
  whiten_abreast<NumberPair>(noise, signals.data(), whitened.data(), v[0].size());
}

void whiten_four(const NoiseModel& noise, std::array<std::span<const double>, 4> v,
                 std::array<std::span<double>, 4> w) {
  const std::array signals{v[0].data(), v[1].data(), v[2].data(), v[3].data()};
  const std::array whitened{w[0].data(), w[1].data(), w[2].data(), w[3].data()};
  best_lane_kernel().whiten_by_fours(noise, signals.data(), whitened.data(), v[0].size());
}

}  // namespace loopscope::core::model
