#include <array>
#include <cstdio>
#include <string>

#include "tests/core/diagnosis/field_tallies.hpp"
#include "tests/core/model/family_balance.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/support/long_run.hpp"
#include "tests/tables/recordings.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::diagnosis {
namespace {

using loopscope::tests::model::FamilyBalance;
using loopscope::tests::model::field_families;
using loopscope::tests::model::FieldFamily;
using tests::recorded_verdict;
using tests::right;
using tests::Tally;
using tests::tally;

constexpr std::size_t kRecords = 12;  // of each family

LOOPSCOPE_TABLE(field_verdict_rates, "sensitivity and specificity of valve_stiction by family") {
  std::array<FamilyBalance, 2> balances;
  for (const FieldFamily& family : field_families()) {
    const Tally found = tally(family, 80'000, loopscope::tests::records(kRecords));
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

LOOPSCOPE_TABLE(field_verdict_recordings, "the recordings of LOOPSCOPE_RECORDINGS=FOLDER") {
  for (const auto& recording : loopscope::tables::recordings()) {
    const bool level = recording.loop.find("LIC") != std::string::npos;
    const Verdict verdict = recorded_verdict(recording.sp, recording.pv, recording.op, level);
    std::printf("| %s | %s | %s | %.2f |\n", recording.name.c_str(), recording.label.c_str(),
                std::string(name(verdict.code)).c_str(), verdict.confidence);
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
