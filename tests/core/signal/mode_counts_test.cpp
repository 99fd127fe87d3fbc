#include "core/signal/mode_counts.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::signal {
namespace {

TEST(ModeCounts, CascadeIsAutomaticAndUnknownIsNotKnown) {
  const std::vector<ControlMode> mode{ControlMode::manual, ControlMode::automatic,
                                      ControlMode::cascade, ControlMode::unknown};
  const ModeCounts counts = count_modes(mode);
  EXPECT_EQ(counts.manual, 1U);
  EXPECT_EQ(counts.automatic, 2U);
  EXPECT_EQ(counts.unknown, 1U);
  EXPECT_EQ(counts.known(), 3U);
}

TEST(ModeCounts, NothingIsKnownOfNothing) {
  EXPECT_EQ(count_modes({}).known(), 0U);
}

}  // namespace
}  // namespace loopscope::core::signal
