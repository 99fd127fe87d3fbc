#include "core/model/results/phrases.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

TEST(Phrases, FiguresAsEngineersSayThem) {
  EXPECT_EQ(in_digits(3.14159), "3.14");
  EXPECT_EQ(in_time(45.0), "45 s");
  EXPECT_EQ(in_time(750.0), "12.5 min");
  EXPECT_EQ(in_time(11520.0), "3.2 h");
  EXPECT_EQ(at_place(1840, 1.0), "30.7 min into the window (sample 1840)");
  EXPECT_EQ(in_percent(0.123), "12 %");
}

}  // namespace
}  // namespace loopscope::core::model
