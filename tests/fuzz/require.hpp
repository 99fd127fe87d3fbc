#pragma once

#include <string_view>

namespace loopscope::tests::fuzz {

/// Ends the process with a message when a property does not hold: libFuzzer keeps the input.
void require(bool holds, std::string_view property);

}  // namespace loopscope::tests::fuzz
