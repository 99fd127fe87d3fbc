#include "config/syntax_problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Case {
  const char* name;
  const char* text;
  const char* line;  ///< "path: message"
  const char* hint;  ///< contained in the hint
};

/// Keeps addresses out of the names that CTest shows.
void PrintTo(const Case& syntax_case, std::ostream* stream) {
  *stream << syntax_case.name;
}

class SyntaxProblem : public testing::TestWithParam<Case> {};

TEST_P(SyntaxProblem, SaysWhereAndWhatWasExpected) {
  EXPECT_THAT(lines_of(GetParam().text), testing::ElementsAre(GetParam().line));
  EXPECT_THAT(first_hint_of(GetParam().text), HasSubstr(GetParam().hint));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SyntaxProblem,
    testing::Values(
        Case{"EmptyFile", "", "line 1, column 1: unexpected end of input; expected a value",
             "one JSON object"},
        Case{"TrailingCommaInObject", "{\"a\": 1,\n}",
             "line 2, column 1: unexpected '}'; expected a key in double quotes", "no comma"},
        Case{"TrailingCommaInArray", "{\"a\": [1, 2,]}",
             "line 1, column 13: unexpected ']'; expected a value", "no comma"},
        Case{"MissingComma", "{\"a\": \"ü\"\n  \"b\": 2}",
             "line 2, column 3: unexpected text; expected ',' or '}'", "comma missing"},
        Case{"MissingColon", "{\"a\" 1}", "line 1, column 6: unexpected number; expected ':'", ""},
        Case{"CharactersNotBytesAreCounted", "{\"größe\" 1}",
             "line 1, column 10: unexpected number; expected ':'", ""},
        Case{"KeyWithoutQuotes", "{a: 1}", "line 1, column 2: invalid literal", ""},
        Case{"UnclosedObject", "{\"a\": 1",
             "line 1, column 8: unexpected end of input; expected ',' or '}'", ""},
        Case{"UnclosedText", "{\"a\": \"x",
             "line 1, column 9: invalid string: missing closing quote", ""},
        Case{"UnclosedComment", "{} /* x",
             "line 1, column 8: invalid comment; missing closing '*/'", ""},
        Case{"TextAfterTheEnd", "{} {}", "line 1, column 4: unexpected '{'; expected end of input",
             ""},
        Case{"HugeNumber", "{\"a\": 1e999}", "line 1, column 11: the number is too large", ""}),
    [](const auto& case_info) { return std::string(case_info.param.name); });

TEST(SyntaxProblem, NeverQuotesTheText) {
  const std::string text = R"({"connection": "password=secret; expected secret \q"})";
  EXPECT_THAT(lines_of(text), testing::ElementsAre(Not(HasSubstr("secret"))));
  EXPECT_THAT(first_hint_of(text), Not(HasSubstr("secret")));
}

}  // namespace
}  // namespace loopscope::config::tests
