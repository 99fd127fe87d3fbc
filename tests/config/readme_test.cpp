#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include "config/describe_settings.hpp"
#include "tests/config/settings_text.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::config::tests {
namespace {

using testing::HasSubstr;

std::string document(const std::string& name) {
  const std::ifstream file(loopscope::tests::source_dir() / "config" / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The first fenced block of a language; empty when there is none.
std::string block(const std::string& language) {
  const std::string text = document("README.md");
  const std::string fence = "```" + language + "\n";
  const std::size_t start = text.find(fence);
  if (start == std::string::npos) return {};
  const std::size_t from = start + fence.size();
  return text.substr(from, text.find("```", from) - from);
}

TEST(Readme, TheTableOfSettingsIsWhatTheProgramDescribes) {
  EXPECT_THAT(document("SETTINGS.md"), HasSubstr("\n\n" + describe_settings() + "\n"))
      << "replace the table in config/SETTINGS.md by:\n"
      << describe_settings();
}

TEST(Readme, ExampleIsAccepted) {
  const std::string example = block("jsonc");
  ASSERT_FALSE(example.empty());
  EXPECT_THAT(lines_of(example), testing::IsEmpty());
}

TEST(Readme, WrongFileHasTheProblemsThatItShows) {
  std::string rows = "| path | problem | hint |\n|---|---|---|\n";
  for (const Problem& problem : problems_of(block("json")))
    rows += "| `" + problem.path + "` | " + problem.message + " | " + problem.hint + " |\n";
  EXPECT_THAT(document("README.md"), HasSubstr("\n\n" + rows + "\n"));
}

}  // namespace
}  // namespace loopscope::config::tests
