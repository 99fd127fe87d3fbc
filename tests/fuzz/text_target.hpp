#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "daemon/text/failure.hpp"
#include "tests/fuzz/require.hpp"

namespace loopscope::tests::fuzz {

/// Gives the bytes as the text of a file to `check`. A file that is refused is so with its own exit
/// code and with words that help. Returns 0.
template <typename Check>
int check_as_text(const std::uint8_t* data, std::size_t size, Check check) {
  try {
    check(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const daemon::Failure& failure) {
    require(failure.exit_code() == daemon::ExitCode::unusable_data,
            "a file that cannot be used has its own exit code");
    require(!failure.hint().empty(), "a refusal says how to mend it");
  }
  return 0;
}

}  // namespace loopscope::tests::fuzz
