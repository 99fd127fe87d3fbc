#include "daemon/setup/choose_layout.hpp"

#include <gmock/gmock.h>
#include <sstream>

#include "daemon/text/failure.hpp"
#include "tests/daemon/setup/seen_tables.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::vector<storage::SeenTable> two_tables() {
  return {seen_table("a", {{"tag", "text"}, {"time", "timestamptz"}, {"value", "float8"}}),
          seen_table("b", {{"tag", "text"}, {"time", "timestamptz"}, {"value", "float8"}})};
}

TEST(ChooseLayout, SomebodyAtATerminalIsAsked) {
  std::istringstream in("what?\n3\n2\n");
  std::ostringstream out;
  Questions questions(in, out, true);
  EXPECT_EQ(choose_layout(two_tables(), {}, questions).historian.table, "public.b");
  EXPECT_THAT(out.str(), HasSubstr("  1. public.a: preset narrow"));
  EXPECT_THAT(out.str(), HasSubstr("a number from 1 to 2"));
}

TEST(ChooseLayout, WithoutATerminalTheOptionIsNamed) {
  std::istringstream in;
  std::ostringstream out;
  Questions questions(in, out, false);
  try {
    static_cast<void>(choose_layout(two_tables(), {}, questions));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_STREQ(failure.what(), "2 tables of the historian look like a history");
    EXPECT_THAT(failure.hint(), HasSubstr("--table schema.table"));
  }
  EXPECT_THAT(out.str(), HasSubstr("  2. public.b"));
}

TEST(ChooseLayout, NoHistoryIsUnusableData) {
  std::istringstream in;
  std::ostringstream out;
  Questions questions(in, out, true);
  try {
    static_cast<void>(choose_layout({seen_table("users", {{"name", "text"}})}, {}, questions));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::unusable_data);
    EXPECT_THAT(failure.what(), HasSubstr("public.users"));
  }
  try {
    static_cast<void>(choose_layout({}, {}, questions));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(), "the historian's database has no tables");
    EXPECT_THAT(failure.hint(), HasSubstr("dbname in --historian"));
  }
}

TEST(Questions, AnEmptyAnswerIsTheUsualOne) {
  std::istringstream in("\nhost=db1\n");
  std::ostringstream out;
  Questions questions(in, out, true);
  EXPECT_EQ(questions.text("", "--results", "Results", "host=localhost"), "host=localhost");
  EXPECT_EQ(questions.text("", "--results", "Results", "host=localhost"), "host=db1");
  EXPECT_EQ(questions.text("said", "--results", "Results", ""), "said");
  EXPECT_EQ(out.str(), "Results [host=localhost]: Results [host=localhost]: ");
  EXPECT_THROW(static_cast<void>(questions.text("", "--results", "Results", "")), Failure);
}

}  // namespace
}  // namespace loopscope::daemon
