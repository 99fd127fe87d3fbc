#include "core/text/counted.hpp"

#include <cstddef>
#include <gtest/gtest.h>

namespace loopscope::core::text {
namespace {

TEST(Counted, OneIsNoPlural) {
  EXPECT_EQ(counted(0, "loop", "loops"), "0 loops");
  EXPECT_EQ(counted(std::size_t{1}, "loop", "loops"), "1 loop");
  EXPECT_EQ(counted(2, "loop", "loops"), "2 loops");
}

}  // namespace
}  // namespace loopscope::core::text
