#include "core/model/noise_model.hpp"

#include <cmath>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

using Coefficients = std::array<double, kMostNoiseOrder>;

/// Coefficients of (1 - m1 z^-1)(1 - m2 z^-1)(1 - m3 z^-1) after the leading 1.
Coefficients expanded(const Coefficients& poles) {
  const auto& m = poles;
  return {-(m[0] + m[1] + m[2]), m[0] * m[1] + m[0] * m[2] + m[1] * m[2], -m[0] * m[1] * m[2]};
}

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

/// y(k) = x(k) + sum a x(k-i) - sum c y(k-i).
template <std::size_t Width, std::size_t Order>
void whiten_columns(const Coefficients& a, const Coefficients& c, std::span<double> table) {
  std::array<std::array<double, Width>, Order> x{};
  std::array<std::array<double, Width>, Order> y{};
  double rest_above = 1.0, rest_below = 1.0;  // at rest at the first value: y = x A(1) / C(1)
  for (std::size_t i = 0; i < Order; ++i) {
    rest_above += a[i];
    rest_below += c[i];
  }
  for (std::size_t i = 0; i < Order; ++i) {
    for (std::size_t w = 0; w < Width; ++w) {
      x[i][w] = table[w];
      y[i][w] = table[w] * rest_above / rest_below;
    }
  }
  for (std::size_t row = 0; row < table.size(); row += Width) {
    for (std::size_t w = 0; w < Width; ++w) {
      const double now = table[row + w];
      double value = now;
      for (std::size_t i = 0; i < Order; ++i) value += a[i] * x[i][w] - c[i] * y[i][w];
      for (std::size_t i = Order - 1; i > 0; --i) {
        x[i][w] = x[i - 1][w];
        y[i][w] = y[i - 1][w];
      }
      x[0][w] = now;
      y[0][w] = value;
      table[row + w] = value;
    }
  }
}

template <std::size_t Width>
void whiten_width(const NoiseModel& noise, std::span<double> table) {
  const Coefficients a = expanded(noise.poles);
  switch (noise.order) {
    case 1: return whiten_columns<Width, 1>(a, noise.zeros, table);
    case 2: return whiten_columns<Width, 2>(a, noise.zeros, table);
    default: return whiten_columns<Width, 3>(a, noise.zeros, table);
  }
}

}  // namespace

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

void whiten(const NoiseModel& noise, std::span<double> table, std::size_t width) {
  switch (width) {
    case 4: return whiten_width<4>(noise, table);
    case 8: return whiten_width<8>(noise, table);
    case 12: return whiten_width<12>(noise, table);
    case 16: return whiten_width<16>(noise, table);
    case 20: return whiten_width<20>(noise, table);
    case 24: return whiten_width<24>(noise, table);
    default: throw std::invalid_argument("whiten: width of a table");
  }
}

}  // namespace loopscope::core::model
