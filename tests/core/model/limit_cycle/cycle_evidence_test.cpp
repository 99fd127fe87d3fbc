#include "core/model/limit_cycle/cycle_evidence.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// op that steps up and down, and pv a few samples behind it.
struct Cycling {
  static constexpr std::size_t kSamples = 1200;
  tests::Series op = tests::stepping_op(kSamples, 3);
  tests::Series pv =
      tests::process_record(tests::one_lag(0.8, 3), 1.5, op, tests::white_noise(kSamples, 1, 0.05));
  tests::Series error = tests::white_noise(kSamples, 2, 0.5);
  tests::Series recorded = tests::Series(kSamples, 1.0);
  [[nodiscard]] CycleRecord record() const { return {pv, op, error, recorded}; }
};

TEST(CycleEvidence, CoherenceAloneIsThatOfTheWholeEvidence) {
  const Cycling cycling;
  for (const double period : {12.0, 40.0, 90.0}) {
    const CycleBand band(period);
    EXPECT_EQ(op_coherence(cycling.record(), band),
              gather_cycle_evidence(cycling.record(), band).op_coherence)
        << period;
  }
}

}  // namespace
}  // namespace loopscope::core::model
