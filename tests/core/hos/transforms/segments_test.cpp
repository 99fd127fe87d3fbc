#include "core/hos/transforms/segments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using loopscope::tests::kNaN;

TEST(HosSegments, PaperSettingsGive127) {
  const std::vector<double> record(4096);
  EXPECT_EQ(segment_hop(Settings{}), 32U);
  EXPECT_EQ(segment_starts(record, Settings{}).size(), 127U);
}

TEST(HosSegments, HopFollowsTheOverlapAndIsNeverZero) {
  EXPECT_EQ(segment_hop({.overlap = 0.0}), 64U);
  EXPECT_EQ(segment_hop({.overlap = 0.75}), 16U);
  EXPECT_EQ(segment_hop({.segment_length = 16, .overlap = 0.9}), 2U);
}

TEST(HosSegments, TheLastSegmentIsWhole) {
  EXPECT_THAT(segment_starts(std::vector<double>(63), Settings{}), IsEmpty());
  EXPECT_THAT(segment_starts(std::vector<double>(64), Settings{}), ElementsAre(0));
  EXPECT_THAT(segment_starts(std::vector<double>(127), Settings{}), ElementsAre(0, 32));
  EXPECT_THAT(segment_starts(std::vector<double>(128), Settings{}), ElementsAre(0, 32, 64));
}

TEST(HosSegments, ThoseThatTouchAGapAreDroppedAndTheOthersStay) {
  std::vector<double> record(256);
  record[95] = kNaN;  // in the segments that start at 32 and 64
  EXPECT_THAT(segment_starts(record, Settings{}), ElementsAre(0, 96, 128, 160, 192));
  record[0] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(segment_starts(record, Settings{}), ElementsAre(96, 128, 160, 192));
  record[255] = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(segment_starts(record, Settings{}), ElementsAre(96, 128, 160));
}

}  // namespace
}  // namespace loopscope::core::hos
