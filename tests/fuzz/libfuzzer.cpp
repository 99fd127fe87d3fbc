// What libFuzzer calls, under the preset `fuzz`: the target that this program is of.

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return loopscope::tests::fuzz::LOOPSCOPE_FUZZ_TARGET(data, size);
}
