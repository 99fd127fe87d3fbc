// Tags to loops: the first line is a pattern, every further line a tag of a historian that anybody
// may have named. The tags are grouped by the pattern, and by how the program itself reads names.

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "daemon/catalogue/discover_loops.hpp"
#include "daemon/catalogue/entry_fields.hpp"
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
}

/// Every tag of a loop is one of the tags, and none has two roles or stands in two loops.
void check_loops(const daemon::Discovery& found, const std::vector<std::string>& tags) {
  require(found.unmatched.size() <= tags.size(), "no more tags than there are");
  const std::set<std::string> known(tags.begin(), tags.end());
  for (const storage::CatalogueEntry& loop : found.loops) {
    require(!loop.name.empty() && !loop.pv_tag.empty(), "a loop has a name and a pv");
    require(!loop.sp_tag.empty() || !loop.op_tag.empty(), "something controls it");
    std::set<std::string> of_loop;
    for (const daemon::TagRole& role : daemon::kTagRoles) {
      const std::string& tag = loop.*role.tag;
      if (tag.empty()) continue;
      require(known.contains(tag), "a tag of the historian");
      require(of_loop.insert(tag).second, "one role for one tag");
    }
  }
}

}  // namespace

int fuzz_discovery(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> tags = lines_of({reinterpret_cast<const char*>(data), size});
  if (tags.empty()) return 0;
  const std::string pattern = tags.front();
  // A historian lists each tag once.
  const std::set<std::string> each(tags.begin() + 1, tags.end());
  tags.assign(each.begin(), each.end());
  daemon::NamingRules rules = daemon::naming_rules({}, {}, {});
  check_loops(daemon::discover_loops(tags, rules), tags);
  try {
    rules.patterns = {daemon::TagPattern(pattern)};
  } catch (const std::invalid_argument&) {
    return 0;
  }
  check_tags(rules, tags);
  check_loops(daemon::discover_loops(tags, rules), tags);
  return 0;
}

}  // namespace loopscope::tests::fuzz
