#include "storage/timestamp.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace loopscope::storage {
namespace {

TEST(Timestamp, IsIsoWithMicroseconds) {
  EXPECT_EQ(timestamp_text(0), "1970-01-01 00:00:00.000000+00");
  EXPECT_EQ(timestamp_text(1'735'689'600'123'456), "2025-01-01 00:00:00.123456+00");
  EXPECT_EQ(timestamp_text(-1), "1969-12-31 23:59:59.999999+00");
  EXPECT_EQ(timestamp_text(1'709'210'096'000'000), "2024-02-29 12:34:56.000000+00");
}

TEST(Timestamp, StaysInTheYearsThatAreUnderstood) {
  EXPECT_EQ(timestamp_text(INT64_MIN), "0001-01-01 00:00:00.000000+00");
  EXPECT_EQ(timestamp_text(INT64_MAX), "9999-12-31 23:59:59.999999+00");
}

}  // namespace
}  // namespace loopscope::storage
