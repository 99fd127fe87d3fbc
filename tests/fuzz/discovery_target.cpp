// Tags to loops: the first line is a pattern, every further line a tag of a historian that anybody
// may have named.

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "daemon/catalogue/discover_loops.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void check_tags(const daemon::NamingRules& rules, const std::vector<std::string>& tags) {
  const std::vector<std::string> words = rules.all_words();
  for (const std::string& tag : tags) {
    const auto match = rules.patterns.front().match(tag, words);
    if (!match) continue;
    require(!match->loop.empty() && tag.find(match->loop) != std::string::npos,
            "a loop's name stands in the tag");
    const std::string word = daemon::lower_case(match->word);
    require(std::find(words.begin(), words.end(), word) != words.end(), "a word is a known one");
  }
  const daemon::Discovery found = daemon::discover_loops(tags, rules);
  require(found.unmatched.size() <= tags.size(), "no more tags than there are");
  for (const storage::CatalogueEntry& loop : found.loops)
    require(!loop.name.empty() && !loop.pv_tag.empty(), "a loop has a name and a pv");
}

}  // namespace

int fuzz_discovery(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> tags = lines_of({reinterpret_cast<const char*>(data), size});
  if (tags.empty()) return 0;
  daemon::NamingRules rules = daemon::naming_rules({}, {}, {});
  try {
    rules.patterns = {daemon::TagPattern(tags.front())};
  } catch (const std::invalid_argument&) {
    return 0;
  }
  tags.erase(tags.begin());
  check_tags(rules, tags);
  return 0;
}

}  // namespace loopscope::tests::fuzz
