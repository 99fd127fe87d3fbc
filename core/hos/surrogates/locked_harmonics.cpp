#include "core/hos/surrogates/locked_harmonics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;
using Phases = std::vector<Complex>;

/// The second and the third harmonic: those that are tested (harmonic_test.hpp).
constexpr Eigen::Index kHighest = 3;
/// Of a running mean. Over fewer the fundamental is half noise, and its square takes off what
/// skewed noise is made of.
constexpr double kCyclesOfMean = 2.0;
constexpr double kSamplesOfMean = 32.0;

/// Over `length` samples about each, fewer at either end.
Phases running_mean(const Phases& values, std::size_t length) {
  Phases sums(values.size() + 1);
  for (std::size_t t = 0; t < values.size(); ++t) sums[t + 1] = sums[t] + values[t];
  Phases means(values.size());
  for (std::size_t t = 0; t < values.size(); ++t) {
    const std::size_t first = t - std::min(t, length / 2);
    const std::size_t end = std::min(values.size(), t + length - length / 2);
    means[t] = (sums[end] - sums[first]) / static_cast<double>(end - first);
  }
  return means;
}

/// The fundamental at each sample over its size, which fades where the fundamental does: its phase
/// says nothing there, and jumps.
Phases follow(std::span<const double> signal, double mean, double period) {
  Phases turned(signal.size());
  const Complex step = std::polar(1.0, 2.0 * std::numbers::pi / period);
  Complex turn = 1.0;
  for (std::size_t t = 0; t < signal.size(); ++t) {
    if (std::isfinite(signal[t])) turned[t] = (signal[t] - mean) * std::conj(turn);
    turn *= step;
  }
  const double cycles = std::max(kCyclesOfMean, std::ceil(kSamplesOfMean / period));
  const auto length = static_cast<std::size_t>(std::lround(cycles * period));
  Phases phases = running_mean(running_mean(turned, length), length);
  double usual = 0.0;
  for (const Complex& phase : phases)
    usual += std::norm(phase) / static_cast<double>(phases.size());
  turn = 1.0;
  for (Complex& phase : phases) {
    if (usual > 0.0) phase *= turn / std::sqrt(std::norm(phase) + usual);
    turn *= step;
  }
  return phases;
}

/// Cosine and sine of each harmonic; 0 where the sample is missing.
Eigen::MatrixXd harmonics_of(const Phases& phases, std::span<const double> signal) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(std::ssize(signal), 2 * (kHighest - 1));
  for (Eigen::Index t = 0; t < columns.rows(); ++t) {
    const auto sample = static_cast<std::size_t>(t);
    if (!std::isfinite(signal[sample])) continue;
    Complex harmonic = phases[sample];
    for (Eigen::Index m = 0; m + 1 < kHighest; ++m) {
      harmonic *= phases[sample];
      columns(t, 2 * m) = harmonic.real();
      columns(t, 2 * m + 1) = harmonic.imag();
    }
  }
  return columns;
}

}  // namespace

std::vector<double> without_locked_harmonics(std::span<const double> signal, double period) {
  const double mean = finite_mean(signal).mean;
  const Eigen::MatrixXd columns = harmonics_of(follow(signal, mean, period), signal);
  Eigen::VectorXd x(std::ssize(signal));
  for (Eigen::Index t = 0; t < x.size(); ++t) {
    const double value = signal[static_cast<std::size_t>(t)];
    x[t] = std::isfinite(value) ? value - mean : 0.0;
  }
  const Eigen::MatrixXd products = columns.transpose() * columns;
  const Eigen::VectorXd locked = columns * products.ldlt().solve(columns.transpose() * x);
  std::vector<double> left(signal.begin(), signal.end());
  for (std::size_t t = 0; t < left.size(); ++t) left[t] -= locked[static_cast<Eigen::Index>(t)];
  return left;
}

}  // namespace loopscope::core::hos
