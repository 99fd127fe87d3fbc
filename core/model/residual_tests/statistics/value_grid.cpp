#include "core/model/residual_tests/statistics/value_grid.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "core/model/residual_tests/statistics/centred.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kOnLevels = 0.9;
constexpr double kResultant = 0.95;

struct Level {
  double value = 0.0;
  std::size_t samples = 0;
};

std::vector<Level> levels_of(const std::vector<double>& sorted, double tolerance) {
  std::vector<Level> levels;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= sorted.size(); ++k) {
    if (k < sorted.size() && sorted[k] - sorted[k - 1] <= tolerance) continue;
    if (k - begin > 1) levels.push_back({0.5 * (sorted[begin] + sorted[k - 1]), k - begin});
    begin = k;
  }
  return levels;
}

std::size_t samples_on(const std::vector<Level>& levels) {
  std::size_t samples = 0;
  for (const Level& level : levels) samples += level.samples;
  return samples;
}

/// A distance of one step: most neighbours are one step apart, the tenth part of the distances
/// leaves out a few that are too small.
double neighbour_distance(const std::vector<Level>& levels) {
  std::vector<double> distances;
  for (std::size_t k = 1; k < levels.size(); ++k)
    distances.push_back(levels[k].value - levels[k - 1].value);
  const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
  std::nth_element(distances.begin(), tenth, distances.end());
  return *tenth;
}

/// Least-squares step through the levels, whose numbers are counted from neighbour to neighbour.
double refined(const std::vector<Level>& levels, double step) {
  double number = 0.0;
  double n = 0.0, sum_i = 0.0, sum_v = 0.0, sum_ii = 0.0, sum_iv = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (k > 0) number += std::round((levels[k].value - levels[k - 1].value) / step);
    const double value = levels[k].value - levels.front().value;
    n += 1.0;
    sum_i += number;
    sum_v += value;
    sum_ii += number * number;
    sum_iv += number * value;
  }
  const double spread = n * sum_ii - sum_i * sum_i;
  return spread > 0.0 ? (n * sum_iv - sum_i * sum_v) / spread : step;
}

double resultant(const std::vector<Level>& levels, double step) {
  std::complex<double> sum;
  for (const Level& level : levels)
    sum += std::polar(1.0, 2.0 * std::numbers::pi * (level.value - levels.front().value) / step);
  return std::abs(sum) / static_cast<double>(levels.size());
}

/// Times that a value comes back to a level after another one.
std::size_t count_returns(std::span<const double> values, const std::vector<Level>& levels,
                          double tolerance) {
  std::size_t visits = 0;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values) {
    if (!std::isfinite(value) || std::abs(value - last) <= tolerance) continue;
    last = value;
    ++visits;
  }
  return visits > levels.size() ? visits - levels.size() : 0;
}

/// A stretch without repeated values makes sorting the whole record needless.
bool repeats_itself(std::span<const double> values, double tolerance) {
  constexpr std::size_t kStretch = 512;
  const std::vector<double> sorted = sorted_finite(values.first(std::min(kStretch, values.size())));
  return sorted.size() < kStretch / 2 || 10 * samples_on(levels_of(sorted, tolerance)) > kStretch;
}

}  // namespace

ValueGrid find_grid(std::span<const double> values, double noise_std) {
  const double tolerance = kSameValue * noise_std;
  if (!repeats_itself(values, tolerance)) return {};
  const std::vector<double> sorted = sorted_finite(values);
  const std::vector<Level> levels = levels_of(sorted, tolerance);
  ValueGrid grid;
  grid.levels = levels.size();
  const double on_levels = kOnLevels * static_cast<double>(sorted.size());
  if (levels.size() < 2 || static_cast<double>(samples_on(levels)) < on_levels) return grid;
  const double step = refined(levels, neighbour_distance(levels));
  const double r = resultant(levels, step);
  if (!(step > 0.0 && r >= kResultant)) return grid;
  grid.step = step;
  // Every step that fits into the range could have been found.
  const double looks = (sorted.back() - sorted.front()) / step + 1.0;
  const double evidence = static_cast<double>(levels.size()) * r * r +
                          static_cast<double>(count_returns(values, levels, tolerance));
  grid.p = std::clamp(looks * std::exp(-evidence), std::numeric_limits<double>::min(), 1.0);
  return grid;
}

}  // namespace loopscope::core::model
