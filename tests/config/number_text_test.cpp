#include "config/number_text.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(NumberText, ReadsAsAPersonWritesIt) {
  EXPECT_EQ(number_text(0.0001), "0.0001");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(3600.0), "3600");
  EXPECT_EQ(number_text(2592000.0), "2592000");
  EXPECT_EQ(number_text(-2.5), "-2.5");
  EXPECT_EQ(number_text(1e300), "1e+300");
}

}  // namespace
}  // namespace loopscope::config::tests
