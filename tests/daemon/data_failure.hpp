#pragma once

#include <gtest/gtest.h>

#include "daemon/text/failure.hpp"

namespace loopscope::daemon {

/// The failure that reading unusable data ends with; "no failure" when it ends well. It has to say
/// what mends it.
template <typename Read>
[[nodiscard]] Failure data_failure(Read read) {
  try {
    static_cast<void>(read());
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::unusable_data);
    EXPECT_FALSE(failure.hint().empty());
    return failure;
  }
  return {ExitCode::done, "no failure", "no failure"};
}

}  // namespace loopscope::daemon
