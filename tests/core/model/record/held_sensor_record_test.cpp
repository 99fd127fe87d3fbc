#include "core/model/record/held_sensor_record.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

TEST(RenewedRecord, KeepsOneRowForEachRenewalAtItsPhase) {
  std::vector<double> pv, op;
  for (int k = 0; k < 40; ++k) {
    pv.push_back(static_cast<double>((k + 2) / 4));  // renewed at 2, 6, 10, ...
    op.push_back(static_cast<double>(k));
  }
  const RenewedRecord renewed = renewed_record(pv, op, pv, {}, 4);
  ASSERT_EQ(renewed.pv.size(), 10U);
  EXPECT_EQ(renewed.grid.samples_per_row, 4U);
  EXPECT_EQ(renewed.grid.first_sample, 2U);
  for (std::size_t i = 0; i < renewed.pv.size(); ++i) {
    EXPECT_EQ(renewed.pv[i], static_cast<double>(i + 1));
    // The mean of the samples up to the renewal at 4 i + 2; the first has three.
    const double renewal = 4.0 * static_cast<double>(i) + 2.0;
    EXPECT_EQ(renewed.op[i], i == 0 ? 1.0 : renewal - 1.5);
  }
  EXPECT_EQ(renewed.sp, renewed.pv);
  EXPECT_TRUE(renewed.error.empty());
}

TEST(RenewedRecord, OneSampleARowIsTheRecord) {
  const std::vector<double> pv{1.0, 3.0, 2.0};
  EXPECT_EQ(renewed_record(pv, pv, {}, {}, 1).op, pv);
}

TEST(RenewedRecord, MissingOpIsLeftOutOfTheMean) {
  const std::vector<double> pv{1.0, 2.0, 2.0, 3.0};
  const RenewedRecord renewed = renewed_record(pv, std::vector{1.0, kNaN, kNaN, 4.0}, {}, {}, 2);
  ASSERT_EQ(renewed.op.size(), 2U);
  EXPECT_EQ(renewed.op[0], 1.0);
  EXPECT_EQ(renewed.op[1], 4.0);
}

}  // namespace
}  // namespace loopscope::core::model
