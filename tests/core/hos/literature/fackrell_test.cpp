#include "core/hos/literature/fackrell.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/hos/literature/hinich.hpp"
#include "core/simulate/paper_signals.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

TEST(HosFackrell, CountsWhatPassesTheQuantile) {
  // 2 K bic2 against -2 ln(0.05) = 5.9915: K = 10 puts the limit at bic2 = 0.29957.
  const FackrellTest test = fackrell(std::vector{0.1, 0.29, 0.30, 0.5}, 10, 0.05);
  EXPECT_EQ(test.exceeding, 2U);
  EXPECT_DOUBLE_EQ(test.expected, 0.2);
  EXPECT_NEAR(test.smallest_p, std::exp(-5.0), 1e-15);
}

TEST(HosFackrell, CountIsBinomial) {
  // Two or more of four at probability 0.05: one minus none minus exactly one.
  const FackrellTest test = fackrell(std::vector{0.1, 0.29, 0.30, 0.5}, 10, 0.05);
  EXPECT_NEAR(test.count_p, 1.0 - std::pow(0.95, 4) - 4.0 * 0.05 * std::pow(0.95, 3), 1e-14);
  EXPECT_EQ(fackrell(std::vector{0.1, 0.2}, 10, 0.05).count_p, 1.0);
}

TEST(HosFackrell, OnlyTheCountHasItsLevel) {
  const int records = tests::records(2000);
  const auto draw = [](std::uint64_t seed) { return tests::white_noise(seed); };
  const auto shares = tests::rejections(draw, independent_segments(tests::kRecord), 0.05, records);
  // A count takes steps and stays below its level; 1 - 0.95^256 of records have some significant
  // bifrequency.
  EXPECT_LE(shares.fackrell_count, 0.05 + four_errors(0.05, records));
  EXPECT_GE(shares.fackrell_count, 0.01);
  EXPECT_GT(shares.fackrell_some, 0.99);
}

TEST(HosFackrell, SeesTheSquareOf41) {
  const int records = tests::records(200);
  const auto draw = [](std::uint64_t seed) {
    return simulate::narrow_band_squared(tests::kRecord, seed);
  };
  const auto shares = tests::rejections(draw, independent_segments(tests::kRecord), 0.05, records);
  EXPECT_GE(shares.fackrell_count, 0.6);
}

TEST(HosFackrell, RefusesWhatItCannotUse) {
  const std::vector<double> bic2 = {0.1};
  EXPECT_THROW((void)fackrell({}, 10, 0.05), std::invalid_argument);
  EXPECT_THROW((void)fackrell(bic2, 1, 0.05), std::invalid_argument);
  for (const double alpha : {0.0, 1.0, std::nan("")}) {
    EXPECT_THROW((void)fackrell(bic2, 10, alpha), std::invalid_argument);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
