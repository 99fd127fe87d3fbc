#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/core/model/field_recordings.hpp"

/// The whole program's verdict, valve_stiction or not, on recordings as plants make them.
namespace loopscope::core::diagnosis {
namespace {

using tests::model::FamilyBalance;
using tests::model::field_families;
using tests::model::FieldFamily;

Verdict verdict_of(std::vector<double> sp, std::vector<double> pv, std::vector<double> op,
                   bool integrating) {
  signal::LoopWindow window;
  window.sp = std::move(sp);
  window.pv = std::move(pv);
  window.op = std::move(op);
  return diagnose(window, {}, {.integrating = integrating}).verdict;
}

/// A plant knows which of its loops are level loops.
bool is_level(std::string_view name) {
  return name.find("level") != std::string_view::npos;
}

struct Tally {
  std::map<std::string, int> codes;
  double confidence = 0.0;
  int records = 0;

  void add(const Verdict& verdict) {
    ++codes[std::string(name(verdict.code))];
    confidence += verdict.confidence;
    ++records;
  }
  [[nodiscard]] double accused() const {
    const auto found = codes.find(std::string(name(VerdictCode::valve_stiction)));
    return found == codes.end() ? 0.0 : static_cast<double>(found->second) / records;
  }
};

Tally tally(const FieldFamily& family, std::uint64_t first, std::uint64_t records) {
  Tally result;
  for (std::uint64_t seed = first; seed < first + records; ++seed) {
    const tests::model::FieldLoop loop = record_of(family, seed);
    result.add(verdict_of(loop.sp, loop.pv, loop.op, is_level(family.name)));
  }
  return result;
}

double right(const FieldFamily& family, const Tally& found) {
  return family.sticks ? found.accused() : 1.0 - found.accused();
}

TEST(FieldVerdicts, StickingValvesAreNamedAndHealthyLoopsAreNot) {
  constexpr std::array<std::string_view, 8> kSome = {"stiction_flow_he",
                                                     "stiction_temperature_karnopp",
                                                     "stiction_complicated_flow",
                                                     "stiction_cascade",
                                                     "sine_flow",
                                                     "tight_level",
                                                     "wandering_flow",
                                                     "quantised"};
  FamilyBalance balance;
  for (const FieldFamily& family : field_families()) {
    if (std::ranges::find(kSome, family.name) == kSome.end()) continue;
    balance.add(family.sticks, right(family, tally(family, 10, 8)));
  }
  EXPECT_GE(balance.sensitivity(), 0.8);
  EXPECT_GE(balance.specificity(), 0.8);
}

/// Records of each family; LOOPSCOPE_RECORDS=12 gives the README's table.
std::uint64_t records() {
  const char* const text = std::getenv("LOOPSCOPE_RECORDS");
  return text != nullptr ? std::max(1ULL, std::strtoull(text, nullptr, 10)) : 60;
}

/// core_tests --gtest_also_run_disabled_tests --gtest_filter='FieldVerdicts.DISABLED_Rates'
TEST(FieldVerdicts, DISABLED_Rates) {
  std::array<FamilyBalance, 2> balances;
  for (const FieldFamily& family : field_families()) {
    const Tally found = tally(family, 80'000, records());
    balances[family.for_tuning ? 1 : 0].add(family.sticks, right(family, found));
    std::printf("| %s | %s | %s | %.0f %% | %.2f |", std::string(family.name).c_str(),
                family.sticks ? "sticks" : "does not", family.for_tuning ? "fit" : "score",
                100.0 * found.accused(), found.confidence / found.records);
    for (const auto& [code, count] : found.codes) std::printf(" %s %d", code.c_str(), count);
    std::puts(" |");
    std::fflush(stdout);
  }
  for (const bool tuning : {true, false}) {
    const FamilyBalance& b = balances[tuning ? 1 : 0];
    std::printf("%s: sensitivity %.3f, specificity %.3f, balanced accuracy %.3f\n",
                tuning ? "fit" : "score", b.sensitivity(), b.specificity(), b.accuracy());
  }
}

/// The recordings of LOOPSCOPE_RECORDINGS (a folder with manifest.csv and loops/).
TEST(FieldVerdicts, DISABLED_Recordings) {
  for (const auto& recording : tests::model::field_recordings()) {
    const bool level = recording.loop.find("LIC") != std::string::npos;
    const Verdict verdict = verdict_of(recording.sp, recording.pv, recording.op, level);
    std::printf("| %s | %s | %s | %.2f |\n", recording.name.c_str(), recording.label.c_str(),
                std::string(name(verdict.code)).c_str(), verdict.confidence);
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
