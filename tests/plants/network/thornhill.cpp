#include "tests/plants/network/thornhill.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "core/hos/slow/decimate.hpp"
#include "tests/effects/random.hpp"

namespace loopscope::tests::network {
namespace {

using Complex = std::complex<double>;
using Series = std::vector<double>;

constexpr std::size_t kLongest = 500;  // samples: the cost grows with the square
constexpr std::size_t kSurrogates = 10;
constexpr std::size_t kNeighbours = 8;

double squared_distance(const Series& series, std::size_t i, std::size_t j, std::size_t cycle) {
  double sum = 0.0;
  for (std::size_t k = 0; k < cycle; ++k) {
    const double off = series[i + k] - series[j + k];
    sum += off * off;
  }
  return sum;
}

/// Mean square error of predicting half a cycle ahead from the cycles that look most alike.
double prediction_error(const Series& series, std::size_t cycle) {
  const std::size_t ahead = cycle + cycle / 2 - 1;
  const std::size_t count = series.size() - ahead;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t j = 0; j < count; ++j)
      if (j + cycle <= i || i + cycle <= j)
        others.emplace_back(squared_distance(series, i, j, cycle), j);
    std::nth_element(others.begin(), others.begin() + kNeighbours, others.end());
    double predicted = 0.0;
    for (std::size_t k = 0; k < kNeighbours; ++k)
      predicted += series[others[k].second + ahead] / static_cast<double>(kNeighbours);
    sum += (series[i + ahead] - predicted) * (series[i + ahead] - predicted);
  }
  return sum / static_cast<double>(count);
}

std::vector<double> line_sizes(const Series& series) {
  std::vector<double> sizes(series.size() / 2);
  const auto count = static_cast<double>(series.size());
  for (std::size_t line = 1; line < sizes.size(); ++line) {
    const Complex rotor =
        std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(line) / count);
    Complex phase = 1.0, sum = 0.0;
    for (const double value : series) sum += value * (phase *= rotor);
    sizes[line] = 2.0 * std::abs(sum) / count;
  }
  return sizes;
}

/// The same spectrum with phases drawn anew.
Series surrogate(const std::vector<double>& sizes, std::size_t samples, effects::Random& random) {
  Series series(samples, 0.0);
  for (std::size_t line = 1; line < sizes.size(); ++line) {
    const Complex rotor = std::polar(
        1.0, 2.0 * std::numbers::pi * static_cast<double>(line) / static_cast<double>(samples));
    Complex value = std::polar(sizes[line], random.uniform(0.0, 2.0 * std::numbers::pi));
    for (double& sample : series) sample += (value *= rotor).real();
  }
  return series;
}

}  // namespace

double thornhill_index(const std::vector<double>& signal, double period_samples) {
  const auto factor = static_cast<std::size_t>(std::max(1.0, period_samples / 10.0));
  Series series = core::hos::decimate(signal, factor);
  for (double& value : series)
    if (!std::isfinite(value)) value = 0.0;
  series.resize(std::min(series.size(), kLongest));
  const auto cycle = static_cast<std::size_t>(period_samples / static_cast<double>(factor));
  if (series.size() < 12 * cycle) return 0.0;
  const std::vector<double> sizes = line_sizes(series);
  effects::Random random(1);
  std::vector<double> errors;
  for (std::size_t k = 0; k < kSurrogates; ++k)
    errors.push_back(prediction_error(surrogate(sizes, series.size(), random), cycle));
  double mean = 0.0, squares = 0.0;
  for (const double error : errors) mean += error / static_cast<double>(kSurrogates);
  for (const double error : errors) squares += (error - mean) * (error - mean);
  const double spread = std::sqrt(squares / static_cast<double>(kSurrogates - 1));
  return spread > 0.0 ? (mean - prediction_error(series, cycle)) / (3.0 * spread) : 0.0;
}

}  // namespace loopscope::tests::network
