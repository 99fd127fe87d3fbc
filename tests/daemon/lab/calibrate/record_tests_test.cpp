#include "daemon/lab/calibrate/record_tests.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <thread>

#include "core/hos/analyse.hpp"
#include "core/simulate/paper_signals.hpp"

namespace loopscope::daemon {
namespace {

TEST(RecordTests, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const RecordTest& test : record_tests()) names.insert(test.name);
  EXPECT_EQ(names.size(), kRecordTests);
}

TEST(RecordTests, PublishedPIsAtMostTheLevelWhereNgiIsAboveZero) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto signal = core::simulate::narrow_band_linear(4096, seed);
    for (const double alpha : {0.05, 0.01, 0.3}) {
      core::hos::Settings settings;
      settings.alpha = alpha;
      const auto result = core::hos::analyse(signal, settings);
      for (const double threshold : {0.0, 0.001}) {
        const double p =
            published_p(result->mean_bic2, threshold, result->segments, result->bifrequencies);
        EXPECT_EQ(p <= alpha, result->ngi >= threshold) << seed << ' ' << alpha;
      }
    }
  }
}

TEST(RecordTests, AMeanOfZeroIsNoEvidence) {
  EXPECT_EQ(published_p(0.0, 0.001, 127, 1024), 1.0);
}

TEST(RecordTests, CouplingIsSeenByTheTestsThatExist) {
  const auto outcome = RecordTester({}).test(core::simulate::two_sinusoids_squared(4096, 1));
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_TRUE(outcome.p[i]) << record_tests()[i].name;
    EXPECT_GE(*outcome.p[i], 0.0);
    EXPECT_LE(*outcome.p[i], 1.0);
  }
  EXPECT_LT(*outcome.p[1], 0.01);  // the published rule
  EXPECT_LT(*outcome.p[2], 0.01);  // Hinich, Gaussianity
  EXPECT_LT(*outcome.p[4], 0.01);  // Fackrell
  EXPECT_GT(outcome.estimate_s, 0.0);
  EXPECT_GT(outcome.analyse_s, 0.0);
}

TEST(RecordTests, WhatCannotBeAnalysedHasNoP) {
  const std::vector<double> missing(4096, std::numeric_limits<double>::quiet_NaN());
  for (const auto& p : RecordTester({}).test(missing).p) EXPECT_FALSE(p);
  for (const auto& p : RecordTester({}).test(std::vector<double>(4096, 5.0)).p) EXPECT_FALSE(p);
}

TEST(CpuTime, CountsWorkAndNotWaiting) {
  const double start_s = thread_cpu_s();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const double slept_s = thread_cpu_s() - start_s;
  EXPECT_LT(slept_s, 0.1);
  while (thread_cpu_s() - start_s < slept_s + 0.01) {
  }
  EXPECT_GE(thread_cpu_s() - start_s, slept_s + 0.01);
}

}  // namespace
}  // namespace loopscope::daemon
