#include "config/describe_settings.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "config/setting_table.hpp"

namespace loopscope::config::tests {
namespace {

using testing::HasSubstr;

TEST(DescribeSettings, HoldsEverySetting) {
  const std::string table = describe_settings();
  for (const Setting& setting : setting_table())
    EXPECT_THAT(table, HasSubstr("| `" + std::string(setting.path) + "` |"));
}

TEST(DescribeSettings, RowsHaveDefaultRangeUnitAndMeaning) {
  const std::string table = describe_settings();
  EXPECT_THAT(
      table, HasSubstr("| `/schedule/poll_s` | `10` | 0.1 to 3600 s | interval between two polls"));
  EXPECT_THAT(table, HasSubstr("| `/analysis/hos/segment_length` | `64` | whole number, 16 to 4096 "
                               "samples, even |"));
  EXPECT_THAT(table, HasSubstr("| `/results/connection` | required |"));
  EXPECT_THAT(table, HasSubstr("| `/historians/*/writer_connection` | empty |"));
}

}  // namespace
}  // namespace loopscope::config::tests
