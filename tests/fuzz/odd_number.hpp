#pragma once

#include "tests/fuzz/byte_source.hpp"

namespace loopscope::tests::fuzz {

/// A double with which arithmetic goes wrong more often than with others (zeros, infinities, NaN,
/// the largest, denormal ones, whole steps), or any eight bytes.
[[nodiscard]] double odd_number(ByteSource& source);

}  // namespace loopscope::tests::fuzz
