#include "core/plant/loop_records.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "core/plant/event.hpp"
#include "tests/core/plant/oscillators.hpp"

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kRecord = 4096;
constexpr std::size_t kMeans = 8;
constexpr std::size_t kSpan = kMeans * kRecord;
constexpr double kPeriod = 1173.0;  // 3.5 of them in the record, 28 in the longer one

std::vector<double> means_of(const std::vector<double>& values) {
  std::vector<double> means;
  for (std::size_t k = 0; k + kMeans <= values.size(); k += kMeans) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kMeans; ++i) sum += values[k + i];
    means.push_back(sum / kMeans);
  }
  return means;
}

/// A loop of one second whose longer span swings slowly.
struct FastLoop {
  std::vector<double> span, newest, means;

  FastLoop(const tests::Course& course, double noise, std::mt19937_64& random)
      : span(tests::draw_error(course, kPeriod, 0, noise, kSpan, random)),
        newest(span.end() - kRecord, span.end()),
        means(means_of(span)) {}

  [[nodiscard]] MemberLoop loop(std::int64_t id) const {
    MemberLoop loop = tests::oscillating_loop(id, newest);
    const std::int64_t before_us = 1'000'000LL * (kSpan - kRecord);
    loop.longer = {kMeans, loop.start_us - before_us + 3'500'000LL, means};
    return loop;
  }
};

TEST(LoopRecords, ASwingThatIsTooSlowForTheRecordIsReadFromTheLongerOne) {
  std::mt19937_64 random(91);
  const tests::Course course = tests::draw_course(kSpan, kPeriod, 0.2, random);
  const FastLoop fast(course, 0.3, random);
  const MemberLoop loop = fast.loop(1);
  MemberLoop short_one = loop;
  short_one.longer = {};
  EXPECT_GT(LoopRecords(loop).slower_share(), 0.7);
  EXPECT_TRUE(LoopRecords(short_one).envelope(1.0 / kPeriod).points.empty());
  const LoopRecords records(loop);
  EXPECT_GE(records.envelope(1.0 / kPeriod).points.size(), 20U);
  const std::vector<SpectralLine> lines = records.lines(0.01);
  ASSERT_FALSE(lines.empty());
  EXPECT_NEAR(1.0 / lines.front().frequency_hz, kPeriod, 0.05 * kPeriod);
}

TEST(LoopRecords, FastSwingsAreReadFromTheRecordItself) {
  std::mt19937_64 random(92);
  const tests::Course course = tests::draw_course(kSpan, 40.0, 0.2, random);
  FastLoop fast(course, 0.3, random);
  fast.newest = tests::draw_error(course, 40.0, 0, 0.3, kRecord, random);
  const MemberLoop loop = fast.loop(1);
  MemberLoop short_one = loop;
  short_one.longer = {};
  EXPECT_LT(LoopRecords(loop).slower_share(), 0.2);
  const double f = 1.0 / 40.0;
  EXPECT_EQ(LoopRecords(loop).share(f), LoopRecords(short_one).share(f));
  EXPECT_EQ(LoopRecords(loop).envelope(f).points, LoopRecords(short_one).envelope(f).points);
}

TEST(LoopRecords, FastLoopsJoinTheEventOfASlowOne) {
  int found = 0;
  constexpr int kPlants = 20;
  for (std::uint64_t seed = 0; seed < kPlants; ++seed) {
    std::mt19937_64 random(100 + seed);
    const tests::Course course = tests::draw_course(kSpan, kPeriod, 0.2, random);
    const tests::Course other = tests::draw_course(kSpan, 31.0, 1.5, random);
    const FastLoop level(course, 0.2, random), beside(other, 0.5, random);
    std::vector<FastLoop> flows;
    for (int k = 0; k < 4; ++k) flows.emplace_back(course, 0.6, random);
    MemberLoop slow = level.loop(0);  // sampled every eight seconds
    slow.sample_interval_s = slow.longer.sample_interval_s;
    slow.start_us = slow.longer.start_us;
    slow.error = slow.longer.error;
    slow.longer = {};
    std::vector<MemberLoop> loops{slow, beside.loop(9)};
    for (std::size_t k = 0; k < flows.size(); ++k)
      loops.push_back(flows[k].loop(static_cast<std::int64_t>(k) + 1));
    for (const Event& event : find_events(loops, {}))
      found +=
          std::abs(event.frequency_hz * kPeriod - 1.0) < 0.05 && event.members.size() == 5 ? 1 : 0;
  }
  EXPECT_GE(found, 17);
}

}  // namespace
}  // namespace loopscope::core::plant
