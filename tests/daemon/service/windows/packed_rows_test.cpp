#include "daemon/service/windows/packed_rows.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::Hold;
using core::signal::kMissing;
using core::signal::RawSeries;

constexpr std::size_t kWindow = 4096;
constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

void expect_same(const RawSeries& found, const RawSeries& rows) {
  EXPECT_EQ(found.hold, rows.hold);
  ASSERT_EQ(found.time_us, rows.time_us);
  ASSERT_EQ(found.value.size(), rows.value.size());
  for (std::size_t k = 0; k < rows.value.size(); ++k) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(found.value[k]),
              std::bit_cast<std::uint64_t>(rows.value[k]))
        << k;
  }
}

/// A minute apart, `value` of each sample of an AR(1) about 50.
template <typename Value>
RawSeries regular(Value value) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  RawSeries rows;
  double state = 0.0;
  for (std::size_t k = 0; k < kWindow; ++k) {
    state = 0.95 * state + normal(random);
    rows.time_us.push_back(kStart_us + static_cast<std::int64_t>(k) * 60'000'000);
    rows.value.push_back(value(50.0 + 2.0 * state));
  }
  return rows;
}

TEST(PackedRows, ComeBackBitForBitWhateverTheyAre) {
  constexpr double kOdd[] = {kMissing, 0.0,  -0.0,  1e300, -1e-300,      21.37,
                             21.4,     -7.0, 123.0, 1e-7,  2147483647.0, -2147483648.0};
  std::mt19937_64 random(1);
  for (int round = 0; round < 2000; ++round) {
    RawSeries rows;
    rows.hold = static_cast<Hold>(random() % 3);
    const std::size_t kinds = 1 + random() % std::size(kOdd);
    for (std::size_t k = random() % 40; k > 0; --k) {
      rows.time_us.push_back(static_cast<std::int64_t>(random()) >> (random() % 64));
      rows.value.push_back(kOdd[random() % kinds]);
    }
    expect_same(PackedRows(rows).unpack(), rows);
  }
}

TEST(PackedRows, KeepTheEndsOfTime) {
  RawSeries rows;
  rows.time_us = {std::numeric_limits<std::int64_t>::min(), 0,
                  std::numeric_limits<std::int64_t>::max()};
  rows.value = {1.0, std::numeric_limits<double>::denorm_min(), -1.0};
  expect_same(PackedRows(rows).unpack(), rows);
}

// A loop of three tags with its setpoint at rest, or values of single precision or a decimal grid,
// takes 60 kB; with random mantissas 100.
TEST(PackedRows, TakeLittle) {
  const RawSeries at_rest = regular([](double) { return 42.5; });
  const RawSeries full = regular([](double value) { return value; });
  const RawSeries single = regular([](double value) { return static_cast<float>(value); });
  const RawSeries grid = regular([](double value) { return std::round(value * 1e4) / 1e4; });
  for (const RawSeries* rows : {&at_rest, &full, &single, &grid})
    expect_same(PackedRows(*rows).unpack(), *rows);
  EXPECT_LT(PackedRows(at_rest).bytes(), 200U);
  EXPECT_LT(PackedRows(at_rest).bytes() + 2 * PackedRows(full).bytes(), 60'000U);
  EXPECT_LT(3 * PackedRows(single).bytes(), 60'000U);
  EXPECT_LT(3 * PackedRows(grid).bytes(), 60'000U);
  EXPECT_LT(3 * PackedRows(full).bytes(), 100'000U);
}

TEST(PackedRows, TakeLittleWhereStampsJitter) {
  RawSeries rows = regular([](double value) { return static_cast<float>(value); });
  std::mt19937_64 random(3);
  for (std::int64_t& time_us : rows.time_us)
    time_us += static_cast<std::int64_t>(random() % 1000) * 1000;
  expect_same(PackedRows(rows).unpack(), rows);
  EXPECT_LT(3 * PackedRows(rows).bytes(), 100'000U);
}

}  // namespace
}  // namespace loopscope::daemon
