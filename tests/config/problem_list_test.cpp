#include "config/problem_list.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(ProblemList, ConclusionsFromRefusedValuesAreDropped) {
  ProblemList problems;
  problems.add({"/a/b", "wrong", {}});
  problems.add({"/section", "no object", {}});
  problems.add_unless_refused({"/a/c", "/a/b"}, "drawn from a refused value", {});
  problems.add_unless_refused({"/section/x"}, "drawn from a refused section", {});
  EXPECT_EQ(problems.problems().size(), 2U);
}

TEST(ProblemList, ConclusionsFromGoodValuesStayUnderTheirFirstPath) {
  ProblemList problems;
  problems.add({"/a/bc", "wrong", {}});
  problems.add_unless_refused({"/a/b", "/a/d"}, "too small", "enlarge it");
  ASSERT_EQ(problems.problems().size(), 2U);
  EXPECT_EQ(problems.problems()[1].path, "/a/b");
  EXPECT_EQ(problems.problems()[1].hint, "enlarge it");
}

}  // namespace
}  // namespace loopscope::config::tests
