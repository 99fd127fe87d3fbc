#include "core/hos/coupling/harmonic_filters.hpp"

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

HarmonicFilters::Amplitudes HarmonicFilters::apply(std::span<const double> signal,
                                                   const Kernels& kernels) const {
  static_assert(FilterTaps::kColumns == 2 * kHarmonics);
  Amplitudes result;
  const std::size_t most = signal.size() / hop_ + 1;
  for (std::vector<Complex>& harmonic : result.harmonics) harmonic.reserve(most);
  result.positions.reserve(most);
  const bool complete = kernels.scan(signal).complete;
  std::size_t checked = complete ? signal.size() : 0;
  std::size_t after_gap = 0;  // one past the last missing sample so far
  for (std::size_t start = 0; start + length() <= signal.size(); start += hop_) {
    for (; checked < start + length(); ++checked) {
      if (!std::isfinite(signal[checked])) after_gap = checked + 1;
    }
    if (start < after_gap) continue;
    std::array<double, FilterTaps::kColumns> amplitudes{};
    kernels.apply_taps({taps_.data(), length()}, signal.data() + start, amplitudes.data());
    for (std::size_t h = 0; h < result.harmonics.size(); ++h) {
      result.harmonics[h].emplace_back(amplitudes[2 * h], amplitudes[2 * h + 1]);
    }
    result.positions.push_back(start / hop_);
  }
  return result;
}

std::vector<Complex> HarmonicFilters::noise_correlation(std::size_t harmonic) const {
  std::vector<Complex> correlation;
  const auto column = static_cast<Eigen::Index>(2 * (harmonic - 1));
  for (std::size_t shift = 0; shift < length(); shift += hop_) {
    const auto count = static_cast<Eigen::Index>(length() - shift);
    const auto late_re = taps_.col(column).tail(count);
    const auto late_im = taps_.col(column + 1).tail(count);
    const auto early_re = taps_.col(column).head(count);
    const auto early_im = taps_.col(column + 1).head(count);
    correlation.emplace_back(late_re.dot(early_re) + late_im.dot(early_im),
                             late_im.dot(early_re) - late_re.dot(early_im));
  }
  const double power = correlation.front().real();
  for (Complex& value : correlation) value /= power;
  return correlation;
}

}  // namespace loopscope::core::hos
