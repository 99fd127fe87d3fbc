#include "core/hos/transforms/paired_spectra.hpp"

#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

#include "core/hos/kernels/triple_tile.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosPairedSpectra, FillsTheRowsByTheDefinition) {
  constexpr std::size_t kLength = 24;
  constexpr std::size_t kDft = 36;
  const auto signal = tests::white_noise(1, kLength * kLanes);
  const std::vector<double> window = tests::white_noise(2, kLength);
  AlignedVector rows((kDft / 2 + 1) * SpectrumRows::kRows * kLanes, 0.0);
  SegmentBatch batch{{}, 0.5, window.data(), nullptr, rows.data(), kLanes};
  for (std::size_t i = 0; i < kLanes; ++i) batch.segments[i] = signal.data() + i * kLength;
  PairedSpectra(kLength, kDft).transform(batch);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::span segment(batch.segments[i], kLength);
    const double mean = std::accumulate(segment.begin(), segment.end(), 0.0) / kLength;
    for (std::size_t k = 0; k <= kDft / 2; ++k) {
      std::complex<double> sum;
      for (std::size_t n = 0; n < kLength; ++n) {
        const double turn = static_cast<double>(k * n) / kDft;
        sum +=
            0.5 * window[n] * (segment[n] - mean) * std::polar(1.0, -2.0 * std::numbers::pi * turn);
      }
      const double* const row = rows.data() + k * SpectrumRows::kRows * kLanes + i;
      EXPECT_NEAR(row[0], sum.real(), 1e-13);
      EXPECT_NEAR(row[kLanes], sum.imag(), 1e-13);
      EXPECT_NEAR(row[2 * kLanes], std::norm(sum), 1e-12);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
