#pragma once

#include <cstddef>
#include <cstdint>

/// What every fuzz target defines: runs one input and ends the process (require.hpp, a sanitizer)
/// when a property does not hold. Returns 0. The name is libFuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
