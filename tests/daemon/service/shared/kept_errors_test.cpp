#include "daemon/service/shared/kept_errors.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

core::plant::PackedError error(std::int64_t start_us, const core::signal::Samples& samples) {
  return {samples, 2.0, start_us};
}

TEST(KeptErrors, GivesAwayWhatFitsByLoopAndSlot) {
  KeptErrors errors;
  errors.keep(1, 60, error(7, {0.5, 1.5}));
  EXPECT_FALSE(errors.take(1, 60)) << "nothing is allowed at first";
  errors.allow(4 * sizeof(std::int16_t));
  errors.keep(1, 60, error(7, {0.5, 1.5}));
  errors.keep(2, 60, error(8, {2.5, 3.5}));
  errors.keep(3, 60, error(9, {4.5}));
  EXPECT_FALSE(errors.take(1, 120)) << "another slot";
  EXPECT_FALSE(errors.take(3, 60)) << "no room was left";
  const auto kept = errors.take(1, 60);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->start_us(), 7);
  EXPECT_EQ(kept->sample_interval_s(), 2.0);
  ASSERT_EQ(kept->size(), 2U);
  EXPECT_NEAR(kept->unpacked()[0], 0.5, 1e-4);
  EXPECT_NEAR(kept->unpacked()[1], 1.5, 1e-4);
  EXPECT_FALSE(errors.take(1, 60)) << "given away";
  errors.keep(3, 60, error(9, {4.5}));
  EXPECT_TRUE(errors.take(3, 60)) << "its room is free";
}

}  // namespace
}  // namespace loopscope::daemon
