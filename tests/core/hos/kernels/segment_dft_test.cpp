#include "core/hos/kernels/segment_dft.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/transforms/paired_spectra.hpp"
#include "tests/core/hos/runnable_kernels.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

/// Rows of a batch of segments, [frequency][real, imaginary, power][segment].
struct Batch {
  explicit Batch(std::size_t dft_length)
      : signal(tests::white_noise(dft_length, dft_length / 2 * kLanes + 3)),
        window(dft_length / 2),
        scratch(SegmentDft::of_length(dft_length).scratch_size()),
        rows((dft_length / 2 + 1) * SpectrumRows::kRows * kLanes) {
    for (std::size_t n = 0; n < window.size(); ++n) {
      window[n] = 1.0 + 0.5 * std::sin(static_cast<double>(n));
    }
  }
  SegmentBatch view() {
    SegmentBatch batch{{}, 0.25, window.data(), scratch.data(), rows.data(), kLanes};
    // Not on cache lines, and not in order.
    for (std::size_t i = 0; i < kLanes; ++i) {
      batch.segments[i] = signal.data() + 3 + (i * 5 % kLanes) * window.size();
    }
    return batch;
  }
  std::vector<double> signal;
  std::vector<double> window;
  AlignedVector scratch;
  AlignedVector rows;
};

TEST(HosSegmentDft, AgreesWithFftwOnEveryPath) {
  for (const std::size_t length : {64U, 128U, 256U, 512U, 2048U, 8192U}) {
    Batch expected(length);
    PairedSpectra(length / 2, length).transform(expected.view());
    for (const Kernels* kernels : tests::runnable_kernels()) {
      Batch found(length);
      kernels->transform(SegmentDft::of_length(length), found.view());
      // Of the size of the largest bin.
      const double tolerance = 1e-14 * static_cast<double>(length);
      for (std::size_t i = 0; i < found.rows.size(); ++i) {
        const bool power = i / kLanes % SpectrumRows::kRows == 2;
        ASSERT_NEAR(found.rows[i], expected.rows[i],
                    power ? tolerance * static_cast<double>(length) : tolerance)
            << kernels->name << ' ' << length << " at " << i;
      }
    }
  }
}

TEST(HosSegmentDft, AConstantLeavesExactZeros) {
  for (const Kernels* kernels : tests::runnable_kernels()) {
    Batch batch(128);
    for (double& sample : batch.signal) sample = 0.1;
    kernels->transform(SegmentDft::of_length(128), batch.view());
    for (const double value : batch.rows) ASSERT_EQ(value, 0.0) << kernels->name;
  }
}

TEST(HosSegmentDft, IsMadeForTwiceTheSegmentAndPowersOfTwo) {
  EXPECT_TRUE(SegmentDft::made_for(64, 128));
  EXPECT_TRUE(SegmentDft::made_for(32, 64));
  EXPECT_FALSE(SegmentDft::made_for(16, 32));
  EXPECT_FALSE(SegmentDft::made_for(64, 64));
  EXPECT_FALSE(SegmentDft::made_for(64, 256));
  EXPECT_FALSE(SegmentDft::made_for(96, 192));
  EXPECT_FALSE(SegmentDft::made_for(8, 16));
}

TEST(HosSegmentDft, ThePlacesCoverEveryBinOnce) {
  for (const std::size_t length : {32U, 64U, 128U, 1024U}) {
    std::vector<int> seen(length / 2 + 1, 0);
    for (const SegmentDft::Level& level : SegmentDft::of_length(length).levels()) {
      for (const SegmentDft::Place& place : level.places) ++seen.at(place.bin);
    }
    // The kernel writes these two itself.
    EXPECT_EQ(seen.front(), 0);
    EXPECT_EQ(seen.back(), 0);
    for (std::size_t k = 1; k < length / 2; ++k) EXPECT_EQ(seen[k], 1) << length << ' ' << k;
  }
}

}  // namespace
}  // namespace loopscope::core::hos
