#include "tests/fuzz/require.hpp"

#include <cstdio>
#include <cstdlib>

namespace loopscope::tests::fuzz {

void require(bool holds, std::string_view property) {
  if (holds) return;
  std::fprintf(stderr, "property does not hold: %.*s\n", static_cast<int>(property.size()),
               property.data());
  std::abort();
}

}  // namespace loopscope::tests::fuzz
