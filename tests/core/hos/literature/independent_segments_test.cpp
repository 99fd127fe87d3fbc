#include "core/hos/literature/independent_segments.hpp"

#include <gtest/gtest.h>

#include "core/hos/transforms/segments.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosIndependentSegments, AreAsLongAsTheRootOfTheRecord) {
  EXPECT_EQ(independent_segments(4096).segment_length, 64U);
  EXPECT_EQ(independent_segments(4095).segment_length, 62U);
  EXPECT_EQ(independent_segments(1000).segment_length, 30U);
  EXPECT_EQ(independent_segments(0).segment_length, 16U);
  EXPECT_EQ(independent_segments(100'000'000).segment_length, 4096U);
}

TEST(HosIndependentSegments, ShareNoSampleAndNoEnergy) {
  const Settings settings = independent_segments(4096);
  EXPECT_EQ(segment_hop(settings), settings.segment_length);
  EXPECT_EQ(settings.dft_length, settings.segment_length);
  EXPECT_EQ(settings.window, WindowShape::rectangular);
}

TEST(HosIndependentSegments, AreValidForEveryLength) {
  for (std::size_t samples = 0; samples < 20'000; samples += 37) {
    EXPECT_NO_THROW(validate(independent_segments(samples))) << samples;
  }
}

}  // namespace
}  // namespace loopscope::core::hos
