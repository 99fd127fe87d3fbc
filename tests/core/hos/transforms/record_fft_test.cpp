#include "core/hos/transforms/record_fft.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

std::complex<double> direct(const std::vector<double>& record, std::size_t k, std::size_t length) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < record.size(); ++n) {
    const auto turn = static_cast<double>(k * n % length) / static_cast<double>(length);
    sum += std::polar(1.0, -2.0 * std::numbers::pi * turn) * record[n];
  }
  return sum;
}

TEST(HosRecordFft, IsTheDftOfTheRecordPaddedWithZeros) {
  for (const std::size_t length : {2U, 16U, 128U, 130U}) {
    for (const std::size_t samples : {length / 2 + 1, length}) {
      const auto record = tests::white_noise(7, samples);
      const auto spectrum = RecordFft::of_length(length).transform(record);
      ASSERT_EQ(spectrum.size(), length / 2 + 1);
      for (std::size_t k = 0; k < spectrum.size(); ++k) {
        EXPECT_LT(std::abs(spectrum[k] - direct(record, k, length)), 1e-12) << length << ' ' << k;
      }
    }
  }
}

TEST(HosRecordFft, PlansAreKept) {
  EXPECT_EQ(&RecordFft::of_length(256), &RecordFft::of_length(256));
  EXPECT_NE(&RecordFft::of_length(256), &RecordFft::of_length(512));
}

TEST(HosRecordFft, RepeatsItsDigits) {
  const auto record = tests::white_noise(8);
  EXPECT_EQ(RecordFft::of_length(4096).transform(record),
            RecordFft::of_length(4096).transform(record));
}

}  // namespace
}  // namespace loopscope::core::hos
