#include "core/hos/harmonic_filters.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// Periods in a segment. With 1.5 the parabola takes from the fundamental and what leaks into both
/// amplitudes is coherent; from 1.65 on the false alarms are right. More periods leave fewer
/// segments: with 2 a triangle of ten cycles has p = 4e-5, with 1.75 it has 6e-6, with 3 only 3e-3.
constexpr double kPeriodsPerSegment = 1.75;
/// Nine parameters need some samples to average over.
constexpr std::size_t kShortestSegment = 24;
/// Segments overlap by three quarters: with Hann weights hardly anything is gained beyond.
constexpr std::size_t kHopsPerSegment = 4;
constexpr Eigen::Index kParabola = 3;
constexpr Eigen::Index kHarmonics = 3;

/// Columns: 1, t, t^2, then cosine and sine of each harmonic; t = -1 to 1 over the segment.
Eigen::MatrixXd basis(std::size_t length, double period) {
  const auto rows = static_cast<Eigen::Index>(length);
  Eigen::MatrixXd columns(rows, kParabola + 2 * kHarmonics);
  for (Eigen::Index n = 0; n < rows; ++n) {
    const double centred = static_cast<double>(n) - static_cast<double>(length - 1) / 2.0;
    const double t = 2.0 * centred / static_cast<double>(length);
    columns.row(n).head<kParabola>() << 1.0, t, t * t;
    const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * centred / period);
    Complex harmonic = 1.0;
    for (Eigen::Index h = 0; h < kHarmonics; ++h) {
      harmonic *= turn;
      columns(n, kParabola + 2 * h) = harmonic.real();
      columns(n, kParabola + 2 * h + 1) = harmonic.imag();
    }
  }
  return columns;
}

Eigen::VectorXd hann_weights(std::size_t length) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(length));
  for (Eigen::Index n = 0; n < weights.size(); ++n) {
    const double phase =
        2.0 * std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(length);
    weights(n) = 0.5 - 0.5 * std::cos(phase);
  }
  return weights;
}

}  // namespace

HarmonicFilters::HarmonicFilters(double period) {
  const std::size_t length = std::max(
      kShortestSegment, static_cast<std::size_t>(std::lround(kPeriodsPerSegment * period)));
  hop_ = length / kHopsPerSegment;
  const Eigen::MatrixXd columns = basis(length, period);
  const Eigen::MatrixXd weighted = hann_weights(length).asDiagonal() * columns;
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(columns.cols(), 2 * kHarmonics);
  for (Eigen::Index i = 0; i < 2 * kHarmonics; ++i) {
    wanted(kParabola + i, i) = i % 2 == 0 ? 1.0 : -1.0;
  }
  const Eigen::MatrixXd normal = columns.transpose() * weighted;
  taps_ = weighted * normal.ldlt().solve(wanted);
}

HarmonicFilters::Amplitudes HarmonicFilters::apply(std::span<const double> signal) const {
  Amplitudes result;
  std::size_t checked = 0;
  std::size_t after_gap = 0;  // one past the last missing sample so far
  for (std::size_t start = 0; start + length() <= signal.size(); start += hop_) {
    for (; checked < start + length(); ++checked) {
      if (!std::isfinite(signal[checked])) after_gap = checked + 1;
    }
    if (start < after_gap) continue;
    const Eigen::Map<const Eigen::VectorXd> segment(signal.data() + start, taps_.rows());
    const Eigen::Matrix<double, 6, 1> amplitudes = taps_.transpose() * segment;
    for (std::size_t h = 0; h < result.harmonics.size(); ++h) {
      const auto column = static_cast<Eigen::Index>(2 * h);
      result.harmonics[h].emplace_back(amplitudes(column), amplitudes(column + 1));
    }
    result.positions.push_back(start / hop_);
  }
  return result;
}

std::vector<Complex> HarmonicFilters::noise_correlation(std::size_t harmonic) const {
  std::vector<Complex> correlation;
  const auto column = static_cast<Eigen::Index>(2 * (harmonic - 1));
  const auto tap = [this, column](std::size_t n) {
    const auto row = static_cast<Eigen::Index>(n);
    return Complex(taps_(row, column), taps_(row, column + 1));
  };
  for (std::size_t shift = 0; shift < length(); shift += hop_) {
    Complex sum;
    for (std::size_t n = shift; n < length(); ++n) sum += tap(n) * std::conj(tap(n - shift));
    correlation.push_back(sum);
  }
  const double power = correlation.front().real();
  for (Complex& value : correlation) value /= power;
  return correlation;
}

}  // namespace loopscope::core::hos
