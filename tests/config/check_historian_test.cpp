#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

/// "setting: message HINT: hint" of the only problem of a historian with these members.
std::string only_problem(const std::string& members) {
  const std::vector<Problem> problems = problems_of(
      R"({"results": {"connection": "a"}, "historians": [{"connection": "a", )" + members + "}]}");
  if (problems.size() != 1) return std::to_string(problems.size()) + " problems";
  const std::string start = "/historians/0/";
  EXPECT_TRUE(problems[0].path.starts_with(start)) << problems[0].path;
  return problems[0].path.substr(start.size()) + ": " + problems[0].message +
         " HINT: " + problems[0].hint;
}

TEST(CheckHistorian, EveryContradictionSaysWhatToWrite) {
  struct Case {
    const char* members;
    const char* problem;
  };
  for (const Case& one :
       {Case{R"("tag_column": "")",
             "tag_column: is missing, only a wide table has none HINT: the column that says whose "
             "values a row holds"},
        Case{R"("layout": "wide", "value_column": "")",
             "tag_column: is set, but a wide table has a column for every tag HINT: set it to "
             "\"\", or layout to \"loop_row\""},
        Case{R"("value_column": "")", "value_column: is missing HINT: the column of the value"},
        Case{R"("time_kind": "timestamp_local")",
             "time_zone: is missing: local times say nothing without their zone HINT: e.g. "
             "\"Europe/Berlin\"; or set time_kind to \"timestamp_utc\" if they are UTC"},
        Case{R"("time_zone": "Europe/Berlin")",
             "time_zone: is set, but only timestamp_local has a zone HINT: set time_kind to "
             "\"timestamp_local\", or leave time_zone out"},
        Case{R"("time_kind": "epoch_s", "nanos_column": "ns")",
             "nanos_column: is set, but only timestamptz goes with it HINT: "},
        Case{R"("quality_column": "")",
             "quality_rule: \"opcda\" needs a quality column HINT: name it in quality_column, or "
             "set quality_rule to \"none\""},
        Case{R"("quality_rule": "codes")",
             "good_codes: is empty: nothing would be good HINT: list the codes of good values"},
        Case{R"("interpolation_column": "step")",
             "tag_table: is missing, `interpolation_column` needs it HINT: name it, or leave "
             "interpolation_column empty"}})
    EXPECT_EQ(only_problem(one.members), one.problem) << one.members;
}

}  // namespace
}  // namespace loopscope::config::tests
