#include "core/diagnosis/words.hpp"

#include <gtest/gtest.h>
#include <set>

namespace loopscope::core::diagnosis {
namespace {

TEST(Words, EveryCodeHasItsOwnNameAndWords) {
  std::set<std::string_view> names;
  std::set<std::string> summaries;
  for (const VerdictCode code : all_verdict_codes()) {
    names.insert(name(code));
    summaries.insert(summary_of(code));
    EXPECT_FALSE(action_for(code).empty());
  }
  EXPECT_EQ(names.size(), all_verdict_codes().size());
  EXPECT_EQ(summaries.size(), all_verdict_codes().size());
}

TEST(Words, NumbersAreShort) {
  EXPECT_EQ(number(0.0123456), "0.0123");
  EXPECT_EQ(number(-2.0), "-2");
  EXPECT_EQ(percent(0.256), "26 %");
}

TEST(Words, DurationsHaveTheUnitOfTheirSize) {
  EXPECT_EQ(duration(45.0), "45 s");
  EXPECT_EQ(duration(750.0), "12.5 min");
  EXPECT_EQ(duration(10'800.0), "3 h");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
