#include "daemon/lab/reproduce/bifrequency.hpp"

#include <complex>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/hos/transforms/segments.hpp"
#include "core/hos/transforms/window.hpp"

namespace loopscope::daemon {

namespace {

using Complex = std::complex<double>;

/// The window's weights times the Fourier kernel at one frequency.
std::vector<Complex> kernel(const std::vector<double>& window, double frequency) {
  std::vector<Complex> weights(window.size());
  for (std::size_t n = 0; n < window.size(); ++n) {
    const double angle = -2.0 * std::numbers::pi * frequency * static_cast<double>(n);
    weights[n] = std::polar(window[n], angle);
  }
  return weights;
}

Complex transform(std::span<const double> segment, double mean,
                  const std::vector<Complex>& weights) {
  Complex sum;
  for (std::size_t n = 0; n < segment.size(); ++n) sum += (segment[n] - mean) * weights[n];
  return sum;
}

}  // namespace

BifrequencyEstimate estimate_at(std::span<const double> signal, double f1, double f2,
                                const core::hos::Settings& settings) {
  const auto window = core::hos::make_window(settings.window, settings.segment_length);
  const auto first = kernel(window, f1);
  const auto second = kernel(window, f2);
  const auto third = kernel(window, f1 + f2);
  const auto starts = core::hos::segment_starts(signal, settings);
  Complex triple;
  double pair_power = 0.0;
  double sum_power = 0.0;
  for (const std::size_t start : starts) {
    const auto segment = signal.subspan(start, settings.segment_length);
    const double mean =
        std::reduce(segment.begin(), segment.end()) / static_cast<double>(settings.segment_length);
    const Complex pair = transform(segment, mean, first) * transform(segment, mean, second);
    const Complex sum = transform(segment, mean, third);
    triple += pair * std::conj(sum);
    pair_power += std::norm(pair);
    sum_power += std::norm(sum);
  }
  const double power = pair_power * sum_power;
  return {power > 0.0 ? std::norm(triple) / power : 0.0, starts.size()};
}

}  // namespace loopscope::daemon
