#include "core/plant/prewhitening.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kFewest = 8;

/// Means and products of (now, once before, twice before) over the complete triples.
struct Moments {
  double count = 0.0;
  double mean[3] = {0.0, 0.0, 0.0};
  double product[3][3] = {};

  void add(const double* now) {
    const double values[3] = {now[0], now[-1], now[-2]};
    count += 1.0;
    double off[3];
    for (int i = 0; i < 3; ++i) off[i] = values[i] - mean[i];
    for (int i = 0; i < 3; ++i) mean[i] += off[i] / count;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) product[i][j] += off[i] * (values[j] - mean[j]);
  }
};

bool complete(const double* now) {
  return std::isfinite(now[0]) && std::isfinite(now[-1]) && std::isfinite(now[-2]);
}

}  // namespace

std::vector<double> without_own_past(std::span<const double> values) {
  std::vector<double> left(values.size(), std::numeric_limits<double>::quiet_NaN());
  Moments m;
  for (std::size_t k = 2; k < values.size(); ++k)
    if (complete(&values[k])) m.add(&values[k]);
  if (m.count < static_cast<double>(kFewest) || !(m.product[0][0] > 0.0)) return left;
  // A constant direction adds nothing and must not divide by zero.
  const double ridge = 1e-9 * m.product[0][0];
  const double a = m.product[1][1] + ridge, b = m.product[1][2], d = m.product[2][2] + ridge;
  const double determinant = a * d - b * b;
  const double first = (d * m.product[0][1] - b * m.product[0][2]) / determinant;
  const double second = (a * m.product[0][2] - b * m.product[0][1]) / determinant;
  for (std::size_t k = 2; k < values.size(); ++k)
    if (complete(&values[k]))
      left[k] = values[k] - m.mean[0] - first * (values[k - 1] - m.mean[1]) -
                second * (values[k - 2] - m.mean[2]);
  return left;
}

}  // namespace loopscope::core::plant
