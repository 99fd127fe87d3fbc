#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/limit_cycle_shares.hpp"
#include "tests/tables/recordings.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

using Balance = loopscope::tests::model::FamilyBalance;
using loopscope::tests::model::field_families;
using loopscope::tests::model::FieldFamily;
using loopscope::tests::model::FieldLoop;
using tests::judge;
using tests::right_share;
using enum CycleCause::Decision;

LOOPSCOPE_TABLE(limit_cycle_rates, "sensitivity and specificity by family") {
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

/// After / before below 0.8.
LOOPSCOPE_TABLE(limit_cycle_errors_alone, "what the errors decide alone") {
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

LOOPSCOPE_TABLE(limit_cycle_recordings, "the recordings of LOOPSCOPE_RECORDINGS=FOLDER") {
  for (const auto& recording : loopscope::tables::recordings()) {
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

LOOPSCOPE_TABLE(limit_cycle_speed, "milliseconds by family and length") {
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
