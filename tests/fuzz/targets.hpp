#pragma once

#include <cstddef>
#include <cstdint>

namespace loopscope::tests::fuzz {

// What every target defines: runs one input and ends the process (require.hpp, a sanitizer) when a
// property does not hold. Returns 0.
int fuzz_analyze(const std::uint8_t* data, std::size_t size);
int fuzz_array_literal(const std::uint8_t* data, std::size_t size);
int fuzz_binary_array(const std::uint8_t* data, std::size_t size);
int fuzz_catalogue(const std::uint8_t* data, std::size_t size);
int fuzz_discovery(const std::uint8_t* data, std::size_t size);
int fuzz_historian_rows(const std::uint8_t* data, std::size_t size);
int fuzz_recording(const std::uint8_t* data, std::size_t size);
int fuzz_settings(const std::uint8_t* data, std::size_t size);
int fuzz_window(const std::uint8_t* data, std::size_t size);

}  // namespace loopscope::tests::fuzz
