#pragma once
/// Counts the assertions that a test executes: GoogleTest tells its listeners of failed ones only.
/// Compiled into every test program before anything else (tests/CMakeLists.txt).

#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>

namespace loopscope::tests {

/// Of this process, EXPECT_ and ASSERT_ alike, since it began.
inline std::atomic<std::uint64_t> executed_assertions{0};

inline int count_assertion() {
  executed_assertions.fetch_add(1, std::memory_order_relaxed);
  return 0;
}

}  // namespace loopscope::tests

// Every EXPECT_ and ASSERT_ begins with this word of GoogleTest's, which is to keep `else` where it
// belongs and has no other meaning: `switch (0) case 0: default:`.
#ifndef GTEST_AMBIGUOUS_ELSE_BLOCKER_
#error "this GoogleTest begins its assertions otherwise: look for another place to count them"
#endif
// NOLINTBEGIN(readability-identifier-naming): the name is GoogleTest's.
#undef GTEST_AMBIGUOUS_ELSE_BLOCKER_
#define GTEST_AMBIGUOUS_ELSE_BLOCKER_            \
  switch (::loopscope::tests::count_assertion()) \
  case 0:                                        \
  default:
// NOLINTEND(readability-identifier-naming)
