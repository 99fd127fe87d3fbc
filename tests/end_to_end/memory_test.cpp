#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/sanitized.hpp"

namespace loopscope::tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

bool says(const ProgramResult& result, const std::string& words) {
  return result.out.find(words) != std::string::npos;
}

/// Whatever the limit, a pass ends by itself; and between a limit that is enough for all and one
/// that is too small for the program there is one at which the loop with the long window alone is
/// set aside. Where that lies depends on libraries and processor, so it is looked for, by halves.
TEST(Memory, OneAnalysisThatDoesNotFitIsSetAsideAndTheOthersAreDone) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes all address space for itself";
  const Plant plant;
  plant.import_loop("long", 131072, 1);
  for (unsigned seed = 2; seed <= 4; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  plant.write_settings(Plant::settings(
      R"("analysis": {"window_samples": 131072}, "schedule": {"batch_loops": 4},
         "daemon": {"workers": 1, "batches_in_flight": 1})"));
  const auto pass = [&](int limit_mb) {
    plant.sql(
        "delete from loopscope.analysis; delete from loopscope.verdict; update "
        "loopscope.schedule set visible_at = now()");
    return run_program({"/bin/bash", "-c",
                        "ulimit -v " + std::to_string(1024 * limit_mb) +
                            "; exec " LOOPSCOPE_PROGRAM " once --config " + plant.settings_file()});
  };
  int too_small = 100;
  int enough = 1024;
  ASSERT_EQ(pass(enough).exit_code, 0);
  bool is_alone = false;
  while (!is_alone && enough - too_small > 5) {
    const int limit_mb = (too_small + enough) / 2;
    const ProgramResult result = pass(limit_mb);
    ASSERT_THAT(result.exit_code, AnyOf(0, 1, 4)) << limit_mb << " MB: " << result.err;
    is_alone = says(result, "3 new, 0 revised, 0 unchanged, 1 failed");
    if (is_alone) {
      EXPECT_THAT(result.err, HasSubstr("loop \"long\": out of memory"));
    }
    (says(result, "4 new, 0 revised, 0 unchanged, 0 failed") ? enough : too_small) = limit_mb;
  }
  EXPECT_TRUE(is_alone) << "at no limit was the long window alone set aside";
}

}  // namespace
}  // namespace loopscope::tests
