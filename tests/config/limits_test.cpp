#include "config/limits.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(Limits, InWords) {
  constexpr std::string_view kWords[] = {"none", "opcda", "zero"};
  EXPECT_EQ(limits_text(range(0.1, 3600, "s")), "0.1 to 3600 s");
  EXPECT_EQ(limits_text(range(0, 1)), "0 to 1");
  EXPECT_EQ(limits_text(even_range(16, 4096, "samples")), "16 to 4096 samples, even");
  EXPECT_EQ(limits_text(one_of(kWords)), "none, opcda, zero");
  EXPECT_EQ(limits_text(any(Form::optional_text)), "text or empty");
  EXPECT_EQ(limits_text(any(Form::toggle)), "true or false");
}

}  // namespace
}  // namespace loopscope::config::tests
