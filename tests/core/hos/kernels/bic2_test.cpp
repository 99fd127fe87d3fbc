#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

/// Sums as a record might leave them, some far too large for their denominators.
struct Sums {
  explicit Sums(std::size_t dft_length)
      : domain(dft_length),
        real(tests::white_noise(1, domain.size())),
        imaginary(tests::white_noise(2, domain.size())),
        power12(tests::white_noise(3, domain.size())),
        total_power(tests::white_noise(4, dft_length / 2 + 1)) {
    for (double& value : power12) value = std::abs(value);
    for (double& value : total_power) value = std::max(0.0, value);
  }
  PrincipalDomain domain;
  std::vector<double> real;
  std::vector<double> imaginary;
  std::vector<double> power12;
  std::vector<double> total_power;
};

double by_definition(const Sums& sums, std::size_t i) {
  const auto [k1, k2] = sums.domain.at(i);
  if (!(sums.total_power[k1] > 0.0) || !(sums.total_power[k2] > 0.0)) return 0.0;
  const double denominator = sums.power12[i] * sums.total_power[k1 + k2];
  if (!(denominator > 0.0)) return 0.0;
  const double size = sums.real[i] * sums.real[i] + sums.imaginary[i] * sums.imaginary[i];
  return std::min(1.0, size / denominator);
}

TEST(HosBic2Kernels, NormaliseEveryBifrequencyToTheLastDigit) {
  for (const std::size_t dft_length : {8U, 16U, 18U, 22U, 34U, 128U}) {
    Sums sums(dft_length);
    for (const Kernels* kernels : tests::runnable_kernels()) {
      std::vector<double> bic2(sums.domain.size(), -1.0);
      const TripleOutputs outputs{sums.real.data(), sums.imaginary.data(), sums.power12.data()};
      const bool defined =
          kernels->normalise(outputs, sums.total_power.data(), dft_length, bic2.data());
      for (std::size_t i = 0; i < bic2.size(); ++i) {
        ASSERT_EQ(bic2[i], by_definition(sums, i)) << kernels->name << ' ' << dft_length;
      }
      EXPECT_EQ(defined, std::ranges::any_of(bic2, [](double value) { return value > 0.0; }));
    }
  }
}

TEST(HosBic2Kernels, WithoutPowerNothingIsDefined) {
  Sums sums(64);
  std::ranges::fill(sums.total_power, 0.0);
  for (const Kernels* kernels : tests::runnable_kernels()) {
    std::vector<double> bic2(sums.domain.size(), -1.0);
    const TripleOutputs outputs{sums.real.data(), sums.imaginary.data(), sums.power12.data()};
    EXPECT_FALSE(kernels->normalise(outputs, sums.total_power.data(), 64, bic2.data()));
    for (const double value : bic2) EXPECT_EQ(value, 0.0) << kernels->name;
  }
}

TEST(HosBic2Kernels, SumsAreTheSameOnEveryPath) {
  for (const std::size_t count : {1U, 7U, 8U, 100U, 1024U}) {
    std::vector<double> values = tests::white_noise(count, count);
    for (double& value : values) value = std::abs(value);
    const ValueTotals first = tests::runnable_kernels().front()->sum_values(values);
    EXPECT_EQ(first.largest, std::ranges::max(values));
    double sum = 0.0;
    double squares = 0.0;
    for (const double value : values) sum += value;
    for (const double value : values) squares += (value - 0.5) * (value - 0.5);
    EXPECT_NEAR(first.sum, sum, 1e-13 * sum);
    for (const Kernels* kernels : tests::runnable_kernels()) {
      EXPECT_EQ(kernels->sum_values(values).sum, first.sum) << kernels->name;
      EXPECT_EQ(kernels->sum_values(values).largest, first.largest) << kernels->name;
      EXPECT_NEAR(kernels->sum_square_deviations(values, 0.5), squares, 1e-13 * squares);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
