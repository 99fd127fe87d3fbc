#include "tests/verdict/contradictions.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

#include "tests/support/in_threads.hpp"
#include "tests/support/long_run.hpp"
#include "tests/verdict/as_recorded.hpp"

namespace loopscope::tests::verdict {
namespace {

using testing::Contains;
using testing::IsEmpty;

constexpr std::uint64_t kFirstSeed = 700'000;

TEST(Contradictions, NoneStandsInWhatIsSaidOfSimulatedLoops) {
  const std::size_t outputs = records(2000);
  std::mutex mutex;
  in_threads(outputs, std::max(1U, std::thread::hardware_concurrency()), [&](std::size_t k) {
    const LabelledRecord record = draw_record(kFirstSeed + k);
    core::AnalysisSettings settings;
    settings.fit_model = k % 2 == 0;
    const core::Diagnosis diagnosis = core::diagnose(record.window, settings, record.facts);
    const auto found = contradictions_in(diagnosis.evidence, diagnosis.verdict);
    const std::scoped_lock lock(mutex);
    EXPECT_THAT(found, IsEmpty()) << "seed " << kFirstSeed + k << ", "
                                  << core::diagnosis::name(diagnosis.verdict.code);
  });
}

TEST(Contradictions, EachIsSeenWhereItStands) {
  EXPECT_GE(contradictions().size(), 20U);
  const LabelledRecord record = draw_record(kFirstSeed);
  const core::Diagnosis sound = core::diagnose(record.window, {}, record.facts);
  ASSERT_THAT(contradictions_in(sound.evidence, sound.verdict), IsEmpty());
  for (const Contradiction& contradiction : contradictions()) {
    core::Diagnosis spoilt = sound;
    contradiction.spoil(spoilt.evidence, spoilt.verdict);
    EXPECT_THAT(contradictions_in(spoilt.evidence, spoilt.verdict),
                Contains(std::string(contradiction.name)));
  }
}

}  // namespace
}  // namespace loopscope::tests::verdict
