#include "core/hos/bicoherence/triple_sums.hpp"

#include <complex>
#include <gtest/gtest.h>

#include "core/hos/kernels/principal_domain.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

std::complex<double> bin(const Spectra& spectra, std::size_t k, std::size_t segment) {
  return {spectra.real(k)[segment], spectra.imaginary(k)[segment]};
}

/// Every bifrequency of the domain against the formula.
void expect_by_definition(const Spectra& spectra) {
  TripleSums sums;
  sum_triples(spectra, sums);
  const PrincipalDomain domain(spectra.settings().dft_length);
  ASSERT_EQ(sums.real.size(), domain.size());
  for (std::size_t i = 0; i < domain.size(); ++i) {
    const auto [k1, k2] = domain.at(i);
    std::complex<double> triple;
    double power12 = 0.0;
    double magnitude = 0.0;
    for (std::size_t s = 0; s < spectra.segments(); ++s) {
      const std::complex<double> product = bin(spectra, k1, s) * bin(spectra, k2, s);
      triple += product * std::conj(bin(spectra, k1 + k2, s));
      power12 += std::norm(product);
      magnitude += std::abs(product * bin(spectra, k1 + k2, s));
    }
    const double tolerance = 1e-14 * magnitude;
    EXPECT_NEAR(sums.real[i], triple.real(), tolerance) << spectra.kernels().name;
    EXPECT_NEAR(sums.imaginary[i], triple.imag(), tolerance) << spectra.kernels().name;
    EXPECT_NEAR(sums.power12[i], power12, 1e-14 * power12) << spectra.kernels().name;
  }
}

TEST(HosTripleSums, EveryKernelSumsByTheDefinition) {
  // DFT lengths with both parities of rows and of their lengths.
  for (const std::size_t dft_length : {16U, 18U, 20U, 22U, 64U}) {
    for (const Kernels* kernels : tests::runnable_kernels()) {
      Spectra spectra({.segment_length = 16, .dft_length = dft_length}, *kernels);
      spectra.compute(tests::white_noise(dft_length, 16 * 11));
      expect_by_definition(spectra);
    }
  }
}

TEST(HosTripleSums, ThePathIsThatOfTheBestKernels) {
  EXPECT_EQ(processor_path(), best_kernels().name);
}

}  // namespace
}  // namespace loopscope::core::hos
