#include "core/plant/longer_record.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

namespace loopscope::core::plant {
namespace {

constexpr double kInterval_s = 60.0;
constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
constexpr std::int64_t kInterval_us = 60'000'000;
constexpr std::size_t kOf = 8;

signal::Samples swing(std::size_t samples) {
  signal::Samples values(samples);
  for (std::size_t k = 0; k < samples; ++k)
    values[k] = std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 1000.0);
  return values;
}

/// The last `record` samples of a swing as the record, those before it read `late_us` off its grid.
PackedError joined(const signal::Samples& all, std::size_t record, std::int64_t late_us = 0) {
  const std::size_t before = all.size() - record;
  const std::span<const double> values(all);
  const signal::Samples earlier = means_of(values.first(before), kOf);
  const std::int64_t record_start_us = kStart_us + static_cast<std::int64_t>(before) * kInterval_us;
  return longer_record({earlier, start_of_means(kStart_us + late_us, before, kOf, kInterval_s)},
                       PackedError(values.last(record), kInterval_s, record_start_us), kOf);
}

TEST(LongerRecord, IsTheMeansOfTheWhole) {
  const signal::Samples all = swing(4096);
  const PackedError longer = joined(all, 512);
  const signal::Samples found = longer.unpacked();
  const signal::Samples expected = means_of(all, kOf);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-4);
  EXPECT_EQ(longer.start_us(), start_of_means(kStart_us, all.size(), kOf, kInterval_s));
  EXPECT_DOUBLE_EQ(longer.sample_interval_s(), 8.0 * kInterval_s);
}

TEST(LongerRecord, IsTheMeansOfTheWholeForARecordOfAnyLength) {
  const signal::Samples all = swing(4096);
  const std::span<const double> values(all);
  for (const std::size_t count : {5U, 509U, 512U, 515U}) {
    const std::size_t before = all.size() - count;
    const PackedError record(values.last(count), kInterval_s,
                             kStart_us + static_cast<std::int64_t>(before) * kInterval_us);
    // What is read ends within the record.
    const std::int64_t read_us = end_of_earlier(record, kOf) - kStart_us;
    ASSERT_EQ(read_us % kInterval_us, 0);
    const auto read = static_cast<std::size_t>(read_us / kInterval_us) + 1;
    ASSERT_LE(read, all.size());
    const signal::Samples found = longer_record({means_of(values.first(read), kOf),
                                                 start_of_means(kStart_us, read, kOf, kInterval_s)},
                                                record, kOf)
                                      .unpacked();
    const signal::Samples expected = means_of(all, kOf);
    ASSERT_EQ(found.size(), expected.size()) << count;
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-4);
  }
}

TEST(LongerRecord, StandsStampsOfOtherPhase) {
  const signal::Samples all = swing(4096);
  for (const std::int64_t late_us : {-kInterval_us / 2, kInterval_us / 2})
    EXPECT_EQ(joined(all, 512, late_us).size(), 512U);
}

TEST(LongerRecord, TimeThatNeitherHoldsIsMissing) {
  const signal::Samples all = swing(4096);
  const std::span<const double> values(all);
  const signal::Samples earlier = means_of(values.first(1024), kOf);
  const PackedError longer = longer_record(
      {earlier, start_of_means(kStart_us, 1024, kOf, kInterval_s)},
      PackedError(values.last(512), kInterval_s, kStart_us + 3584 * kInterval_us), kOf);
  const signal::Samples found = longer.unpacked();
  ASSERT_EQ(found.size(), 512U);
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_EQ(std::isnan(found[k]), k >= 128 && k < 448) << k;
}

TEST(LongerRecord, StepInBothIsTheRecords) {
  const signal::Samples earlier(64, 1.0), record(256, 2.0);
  // Half of what is earlier lies behind the beginning of the record.
  const PackedError longer = longer_record(
      {earlier, start_of_means(kStart_us - 256 * kInterval_us, 512, kOf, kInterval_s)},
      PackedError(record, kInterval_s, kStart_us), kOf);
  const signal::Samples found = longer.unpacked();
  ASSERT_EQ(found.size(), 64U);
  EXPECT_DOUBLE_EQ(found[31], 1.0);
  EXPECT_DOUBLE_EQ(found[32], 2.0);
}

TEST(LongerRecord, MeansAreOfWhatIsKnown) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const signal::Samples means = means_of(std::vector{9.0, 1.0, 3.0, kGap, 4.0, kGap, kGap}, 2);
  ASSERT_EQ(means.size(), 3U);
  EXPECT_DOUBLE_EQ(means[0], 2.0);
  EXPECT_DOUBLE_EQ(means[1], 4.0);
  EXPECT_TRUE(std::isnan(means[2]));
}

}  // namespace
}  // namespace loopscope::core::plant
