#include "daemon/output/text_line.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(TextLine, LabelsStandInAColumn) {
  EXPECT_EQ(text_line("data", "missing 0"), "  data          missing 0\n");
}

TEST(TextLine, UnknownFiguresAreDashes) {
  EXPECT_EQ(figure_text(0.123456), "0.1235");
  EXPECT_EQ(figure_text(std::nullopt), "-");
}

}  // namespace
}  // namespace loopscope::daemon
