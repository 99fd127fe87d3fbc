#include "tests/core/hos/bispectrum_of_linear_process.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include "core/hos/kernels/principal_domain.hpp"

namespace loopscope::core::hos::tests {
namespace {

constexpr double kThirdMoment = 2.0;

std::complex<double> response(const std::vector<double>& taps, double frequency) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < taps.size(); ++n) {
    sum += taps[n] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(n));
  }
  return sum;
}

std::complex<double> expected_at(const std::vector<double>& taps, Bifrequency at, double bins) {
  const double f1 = static_cast<double>(at.k1) / bins;
  const double f2 = static_cast<double>(at.k2) / bins;
  return kThirdMoment * response(taps, f1) * response(taps, f2) *
         std::conj(response(taps, f1 + f2));
}

}  // namespace

std::vector<double> moving_average(std::span<const double> x, std::span<const double> taps) {
  std::vector<double> y(x.size() - taps.size() + 1);
  for (std::size_t k = 0; k < y.size(); ++k) {
    for (std::size_t n = 0; n < taps.size(); ++n) {
      y[k] += taps[n] * x[k + taps.size() - 1 - n];
    }
  }
  return y;
}

void expect_near_linear(std::span<const std::complex<double>> bispectrum,
                        const std::vector<double>& taps, const Settings& settings,
                        double tolerance) {
  const PrincipalDomain domain(settings.dft_length);
  const auto bins = static_cast<double>(settings.dft_length);
  const std::size_t lobe = 2 * settings.dft_length / settings.segment_length;
  ASSERT_EQ(bispectrum.size(), domain.size());
  double largest_error = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < bispectrum.size(); ++i) {
    const Bifrequency at = domain.at(i);
    if (at.k2 > lobe) {
      const std::complex<double> expected = expected_at(taps, at, bins);
      largest_error = std::max(largest_error, std::abs(bispectrum[i] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  EXPECT_LT(largest_error / largest, tolerance);
  testing::Test::RecordProperty("largest_relative_error", std::to_string(largest_error / largest));
}

}  // namespace loopscope::core::hos::tests
