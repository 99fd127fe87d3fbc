#include "core/model/limit_cycle_cause.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/field_recordings.hpp"

namespace loopscope::core::model {
namespace {

using Balance = tests::model::FamilyBalance;
using tests::model::field_families;
using tests::model::FieldFamily;
using tests::model::FieldLoop;
using tests::model::record_of;
using enum CycleCause::Decision;

CycleCause judge(const FieldLoop& loop) {
  return judge_limit_cycle(loop.pv, loop.op, loop.sp);
}

/// Share of `records` loops of the family that are judged as they are. Undecided is not accused.
double right_share(const FieldFamily& family, std::uint64_t records) {
  std::uint64_t right = 0;
  for (std::uint64_t seed = 0; seed < records; ++seed) {
    const bool accused = judge(record_of(family, seed)).decision == sticks;
    if (accused == family.sticks) ++right;
  }
  return static_cast<double>(right) / static_cast<double>(records);
}

TEST(LimitCycleCause, FamiliesThatTheScoreHasNotSeen) {
  Balance balance;
  for (const FieldFamily& family : field_families()) {
    if (!family.for_tuning) balance.add(family.sticks, right_share(family, 12));
  }
  EXPECT_GT(balance.sensitivity(), 0.8);
  EXPECT_GT(balance.specificity(), 0.8);
}

TEST(LimitCycleCause, ScaleAndOffsetDoNotMatter) {
  FieldLoop loop = record_of(field_families().front(), 3);
  const CycleCause plain = judge(loop);
  for (double& value : loop.pv) value = 250.0 * value - 40.0;
  for (double& value : loop.sp) value = 250.0 * value - 40.0;
  for (double& value : loop.op) value = 0.16 * value + 4.0;
  const CycleCause scaled = judge(loop);
  EXPECT_NEAR(scaled.score, plain.score, 1e-6);
  EXPECT_NEAR(scaled.evidence.stickband, 0.16 * plain.evidence.stickband, 1e-9);
}

TEST(LimitCycleCause, SurvivesMissingSamples) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  FieldLoop loop = record_of(field_families().front(), 3);
  for (std::size_t k = 0; k < loop.pv.size(); k += 17) loop.pv[k] = kMissing;
  for (std::size_t k = 5; k < loop.op.size(); k += 31) loop.op[k] = kMissing;
  loop.pv.front() = loop.op.back() = kMissing;
  const CycleCause cause = judge(loop);
  EXPECT_NE(cause.decision, undecided);
  EXPECT_TRUE(std::isfinite(cause.score));
}

TEST(LimitCycleCause, UndecidedWhereNothingCanBeSaid) {
  const std::vector<double> still(1000, 3.0);
  std::vector<double> moving(1000);
  for (std::size_t k = 0; k < moving.size(); ++k)
    moving[k] = std::sin(0.3 * static_cast<double>(k));
  EXPECT_EQ(judge_limit_cycle(moving, still, {}).decision, undecided);
  EXPECT_EQ(judge_limit_cycle(still, moving, {}).decision, undecided);
  const std::vector<double> nothing(1000, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(judge_limit_cycle(nothing, nothing, nothing).decision, undecided);
  EXPECT_EQ(judge_limit_cycle({}, {}, {}).decision, undecided);
  EXPECT_THROW((void)judge_limit_cycle(moving, std::vector<double>(3), {}), std::invalid_argument);
}

/// core_tests --gtest_also_run_disabled_tests --gtest_filter='LimitCycleCause.DISABLED_Rates'
TEST(LimitCycleCause, DISABLED_Rates) {
  std::array<Balance, 2> balances;
  for (const FieldFamily& family : field_families()) {
    const double right = right_share(family, 100);
    balances[family.for_tuning ? 1 : 0].add(family.sticks, right);
    std::printf("| %s | %s | %s | %.0f %% |\n", std::string(family.name).c_str(),
                family.sticks ? "sticks" : "does not", family.for_tuning ? "fit" : "score",
                100.0 * right);
  }
  for (const bool tuning : {true, false}) {
    const Balance& b = balances[tuning ? 1 : 0];
    std::printf("%s: sensitivity %.3f, specificity %.3f, balanced accuracy %.3f\n",
                tuning ? "fit" : "score", b.sensitivity(), b.specificity(), b.accuracy());
  }
}

/// What the errors decide alone: after / before below 0.8.
TEST(LimitCycleCause, DISABLED_ErrorsAlone) {
  std::array<Balance, 3> balances;
  for (const FieldFamily& family : field_families()) {
    std::array<double, 3> accused{};
    std::vector<double> ratios;
    constexpr std::uint64_t kRecords = 50;
    for (std::uint64_t seed = 0; seed < kRecords; ++seed) {
      const CycleEvidence e = judge(record_of(family, seed)).evidence;
      accused[0] += e.error_law < 0.8 * e.error_before ? 1.0 : 0.0;
      accused[1] += e.error_turning < 0.8 * e.error_before ? 1.0 : 0.0;
      accused[2] += e.part_ratio < 0.8 ? 1.0 : 0.0;
      ratios.push_back(e.part_ratio);
    }
    std::sort(ratios.begin(), ratios.end());
    std::printf("%s: median part_ratio %.2f\n", std::string(family.name).c_str(),
                ratios[kRecords / 2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = accused[i] / static_cast<double>(kRecords);
      balances[i].add(family.sticks, family.sticks ? share : 1.0 - share);
    }
  }
  for (const Balance& b : balances) {
    std::printf("sensitivity %.3f, specificity %.3f, balanced accuracy %.3f\n", b.sensitivity(),
                b.specificity(), b.accuracy());
  }
}

/// The recordings of LOOPSCOPE_RECORDINGS (a folder with manifest.csv and loops/).
TEST(LimitCycleCause, DISABLED_Recordings) {
  for (const auto& recording : tests::model::field_recordings()) {
    const CycleCause cause = judge_limit_cycle(recording.pv, recording.op, recording.sp);
    const CycleEvidence& e = cause.evidence;
    std::printf("| %s | %s | %.0f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %s |\n",
                recording.name.c_str(), recording.label.c_str(), e.cycles, e.error_before,
                e.error_law, e.part_ratio, e.steadiness, e.op_coherence, e.op_triangle, cause.score,
                cause.decision == sticks      ? "sticks"
                : cause.decision == undecided ? "-"
                                              : "no");
  }
}

TEST(LimitCycleCause, DISABLED_Speed) {
  for (const std::size_t family : {0U, 2U, 10U, 26U}) {
    for (const std::size_t samples : {751U, 4096U, 18000U}) {
      FieldLoop loop = record_of(field_families()[family], 1);
      const std::size_t own = loop.pv.size();
      for (std::size_t k = own; k < samples; ++k) {
        loop.pv.push_back(loop.pv[k % own]);
        loop.op.push_back(loop.op[k % own]);
        loop.sp.push_back(loop.sp[k % own]);
      }
      for (auto* v : {&loop.pv, &loop.op, &loop.sp}) v->resize(samples);
      double best = 1e9;
      for (int i = 0; i < 20; ++i) {
        const auto start = std::chrono::steady_clock::now();
        (void)judge(loop);
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count());
      }
      std::printf("| %s | %zu | %.1f ms |\n", std::string(field_families()[family].name).c_str(),
                  samples, best);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
