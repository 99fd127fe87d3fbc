#include "tests/plants/process/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <numeric>

namespace loopscope::tests::process {
namespace {

using Complex = std::complex<double>;

/// In place, of a length that is a power of two (Cooley and Tukey).
void transform(std::vector<Complex>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length <<= 1) {
    const Complex turn = std::polar(1.0, -2.0 * std::numbers::pi / static_cast<double>(length));
    for (std::size_t start = 0; start < n; start += length) {
      Complex phase = 1.0;
      for (std::size_t k = start; k < start + length / 2; ++k, phase *= turn) {
        const Complex odd = values[k + length / 2] * phase;
        values[k + length / 2] = values[k] - odd;
        values[k] += odd;
      }
    }
  }
}

std::vector<double> without_line(const std::vector<double>& series) {
  const auto n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  double slope = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k)
    slope += (static_cast<double>(k) - (n - 1.0) / 2.0) * (series[k] - mean);
  slope *= 12.0 / (n * (n * n - 1.0));
  std::vector<double> rest(series.size());
  for (std::size_t k = 0; k < series.size(); ++k)
    rest[k] = series[k] - mean - slope * (static_cast<double>(k) - (n - 1.0) / 2.0);
  return rest;
}

}  // namespace

Spectrum::Spectrum(const std::vector<double>& series) : length_(std::bit_ceil(series.size())) {
  const std::vector<double> rest = without_line(series);
  std::vector<Complex> values(length_);
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(series.size());
  for (std::size_t k = 0; k < rest.size(); ++k)
    values[k] = rest[k] * (0.5 - 0.5 * std::cos(turn * (static_cast<double>(k) + 0.5)));
  transform(values);
  sums_.push_back(0.0);
  for (std::size_t line = 0; line <= length_ / 2; ++line)
    sums_.push_back(sums_.back() + std::norm(values[line]));
}

double Spectrum::power(double low, double high) const {
  const auto n = static_cast<double>(length_);
  const auto last = static_cast<double>(sums_.size() - 1);
  const auto from = static_cast<std::size_t>(std::clamp(std::ceil(low * n), 0.0, last));
  const auto past = static_cast<std::size_t>(std::clamp(std::floor(high * n) + 1.0, 0.0, last));
  return past > from ? sums_[past] - sums_[from] : 0.0;
}

double Spectrum::line_power(double frequency) const {
  double sum = 0.0;
  double reached = 0.0;
  for (int harmonic = 1; harmonic <= 5; ++harmonic) {
    const double low = std::max(reached, (harmonic - 0.15) * frequency);
    const double high = (harmonic + 0.15) * frequency;
    sum += power(low, high);
    reached = high;
  }
  return sum;
}

double Spectrum::strongest(double lowest) const {
  double best = lowest;
  double most = -1.0;
  for (double f = lowest; f < 0.3; f *= 1.02) {
    const double here = power(0.95 * f, 1.05 * f);
    if (here > most) most = here, best = f;
  }
  return best;
}

double variance(const std::vector<double>& series) {
  const auto n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  double sum = 0.0;
  for (const double value : series) sum += (value - mean) * (value - mean);
  return sum / n;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> rest(a.size());
  std::transform(a.begin(), a.end(), b.begin(), rest.begin(), std::minus<>());
  return rest;
}

}  // namespace loopscope::tests::process
