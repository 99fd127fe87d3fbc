#include "core/signal/base_interval.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/assemble.hpp"
#include "core/signal/gaps.hpp"
#include "tests/core/signal/raw_rows.hpp"

namespace loopscope::core::signal {
namespace {

using tests::rows_at;

/// Scans every `interval_s`, each kept with this probability, stamps off by up to `jitter`
/// intervals.
RawSeries scanned(double interval_s, double kept, double jitter, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> times_s;
  for (int k = 0; k < 4096; ++k) {
    const double off = jitter * (2.0 * uniform(random) - 1.0);
    if (uniform(random) < kept) times_s.push_back((k + off) * interval_s);
  }
  std::ranges::sort(times_s);
  return rows_at(times_s);
}

TEST(BaseInterval, OfPeriodicRowsIsTheUsualOne) {
  const RawSeries rows = rows_at({0, 10, 10, 20, 500, 510, 520, 530, 540, 550, 560, 570});
  EXPECT_EQ(base_interval_s(rows), usual_interval_s(rows));
  EXPECT_EQ(base_interval_s(rows_at({5})), 0.0);
  EXPECT_EQ(base_interval_s({}), 0.0);
}

TEST(BaseInterval, OfCompressedRowsIsTheScansOwn) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    EXPECT_NEAR(base_interval_s(scanned(2.0, 0.4, 0.0, seed)), 2.0, 1e-9);
    EXPECT_NEAR(base_interval_s(scanned(2.0, 0.25, 0.0, seed)), 2.0, 1e-9);
  }
}

/// An error of 1e-4 would move a window's end by half a sample against its start.
TEST(BaseInterval, OfJitteringRowsIsKnownOverTheWholeWindow) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    EXPECT_NEAR(base_interval_s(scanned(0.5, 1.0, 0.3, seed)), 0.5, 1e-5);
    EXPECT_NEAR(base_interval_s(scanned(60.0, 0.5, 0.2, seed)), 60.0, 1e-3);
  }
}

TEST(BaseInterval, JitteringRowsFindTheirSlots) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const RawSeries rows = scanned(1.0, 1.0, 0.3, seed);
    const Grid grid = window_grid(rows, base_interval_s(rows), rows.time_us.back(), 4096);
    const Samples samples = align(rows, grid, Hold::sample);
    EXPECT_GE(samples.size(), 4095U);
    EXPECT_EQ(count_recorded(samples), samples.size());
  }
}

}  // namespace
}  // namespace loopscope::core::signal
