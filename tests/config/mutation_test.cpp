#include <array>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <string_view>

#include "config/read_settings.hpp"
#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

constexpr int kMutants = 20000;

/// What a careless or hostile hand puts into a settings file.
constexpr std::array<std::string_view, 22> kScraps = {"{",        "}",
                                                      "[",        "]",
                                                      ",",        ":",
                                                      "\"",       "\\",
                                                      "null",     "true",
                                                      "-1",       "0",
                                                      "1e308",    "1e999",
                                                      "1e-320",   "-0.0",
                                                      "NaN",      "\"\\ud800\"",
                                                      "\xC3\x28", "/*",
                                                      "//\n",     "18446744073709551616"};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string mutate(std::string text) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }

  void change(std::string& text) {
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(20);
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 3:
        text.insert(at, kScraps[below(kScraps.size())]);
        break;
      case 4:
        replace_number(text, at);
        break;
      default:
        text.resize(at);
        break;
    }
  }

  /// Keeps the syntax right, so that ranges and cross rules are reached.
  void replace_number(std::string& text, std::size_t from) {
    const std::size_t at = text.find_first_of("0123456789", from);
    if (at == std::string::npos) return;
    const std::size_t end = text.find_first_not_of("0123456789.", at);
    text.replace(at, end - at, std::to_string(below(10000)));
  }

  std::mt19937_64 random_;
};

TEST(Mutation, MutantsOfAValidFileAreReadOrRefusedButNothingElse) {
  const std::string valid = complete_text();
  int accepted = 0;
  for (int seed = 0; seed < kMutants; ++seed) {
    const std::string mutant = Mutator(static_cast<std::uint64_t>(seed)).mutate(valid);
    try {
      const Settings settings = parse_settings(mutant, "mutant.json");
      ++accepted;
      // What is accepted can be stored and read again.
      const std::string analysis = analysis_settings_json(settings.analysis);
      EXPECT_TRUE(problems_of(minimal_with("\"analysis\": " + analysis)).empty()) << mutant;
    } catch (const SettingsError& error) {
      EXPECT_FALSE(error.problems().empty()) << mutant;
      for (const Problem& problem : error.problems()) EXPECT_FALSE(problem.message.empty());
    }
  }
  // Both ends are reached: a test that only ever sees broken syntax would prove little.
  EXPECT_GT(accepted, kMutants / 100);
  EXPECT_LT(accepted, kMutants / 2);
}

}  // namespace
}  // namespace loopscope::config::tests
