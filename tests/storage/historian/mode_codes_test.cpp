#include "storage/historian/mode_codes.hpp"

#include <gmock/gmock.h>

#include "core/signal/loop_window.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsNan;

TEST(ModeCodes, ValuesOfASiteBecomeModesAndOthersAreUnknown) {
  core::signal::RawSeries rows{{1, 2, 3, 4, 5}, {16.0, 8.0, 32.0, 1.0, core::signal::kMissing}};
  decode_modes(rows, {{8.0, 4.0}, {16.0}, {32.0, 64.0}});
  EXPECT_THAT(rows.value, ElementsAre(1.0, 0.0, 2.0, 3.0, IsNan()));
}

TEST(ModeCodes, WithoutASitesCodesTheNumbersAreTheModes) {
  core::signal::RawSeries rows{{1, 2, 3}, {0.0, 1.0, 2.0}};
  decode_modes(rows, {});
  EXPECT_THAT(rows.value, ElementsAre(0.0, 1.0, 2.0));
}

}  // namespace
}  // namespace loopscope::storage
