// A line whose period divides the hop of 32 samples stands at the same phase in every segment, and
// its leakage with it: the published rule takes that for coupling. Documentation that runs; the
// figures of daemon/MEASURED.md are what this prints with LOOPSCOPE_RECORDS=2000.

#include <cstdio>
#include <gtest/gtest.h>
#include <string>

#include "core/hos/analyse.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/rejections.hpp"

namespace loopscope::core::hos {
namespace {

/// Share of records that the published rule calls nonlinear.
double fires(const simulate::LimitCycle& cycle, int records) {
  double share = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    const auto signal = simulate::limit_cycle(cycle, 4096, static_cast<std::uint64_t>(1000 * seed));
    share += analyse(signal, {})->published.linear ? 0.0 : 1.0 / records;
  }
  std::printf("| %s | %.1f | %.1f dB | %.1f rad | %.1f %% |\n",
              std::string(simulate::name(cycle.shape)).c_str(), cycle.period_samples, cycle.snr_db,
              cycle.jitter_rad, 100.0 * share);
  return share;
}

TEST(HosLockedLines, APeriodThatDividesTheHopLooksCoupled) {
  const int records = tests::records(50);
  for (const double period : {16.0, 32.0}) {
    EXPECT_GT(fires({simulate::WaveShape::sine, period, 20.0, 0.0}, records), 0.9) << period;
    EXPECT_GT(fires({simulate::WaveShape::sine, period, 20.0, 0.1}, records), 0.9) << period;
  }
}

TEST(HosLockedLines, APeriodBesideItDoesNot) {
  const int records = tests::records(50);
  for (const double period : {16.7, 33.4}) {
    EXPECT_LT(fires({simulate::WaveShape::sine, period, 20.0, 0.0}, records), 0.2) << period;
  }
}

TEST(HosLockedLines, SquaresAndTrianglesAreSeenByThatAlone) {
  const int records = tests::records(50);
  for (const auto shape : {simulate::WaveShape::square, simulate::WaveShape::triangle}) {
    EXPECT_GT(fires({shape, 16.0, 10.0, 0.1}, records), 0.7);
    EXPECT_LT(fires({shape, 16.7, 10.0, 0.1}, records), 0.25);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
