#include "daemon/catalogue/discover_loops.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "daemon/catalogue/entry_fields.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

/// A tag that may fill a role; `rank` is the place of its word in the role's list.
struct Candidate {
  std::string tag;
  std::string word;
  std::string loop;  ///< as this tag spells it
};

/// Place of a word among those of a role; nullopt = it is none of them.
std::optional<std::size_t> rank_of(const NamingRules& rules, std::string_view role,
                                   const std::string& word) {
  const auto list = rules.words.find(role);
  if (list == rules.words.end()) return std::nullopt;
  const auto found = std::ranges::find(list->second, word);
  if (found == list->second.end()) return std::nullopt;
  return static_cast<std::size_t>(found - list->second.begin());
}

std::optional<TagMatch> match(const std::string& tag, const NamingRules& rules,
                              const std::vector<std::string>& words) {
  for (const TagPattern& pattern : rules.patterns) {
    if (auto found = pattern.match(tag, words)) return found;
  }
  return std::nullopt;
}

/// One loop while its tags are given their roles.
class Loop {
 public:
  Loop(const std::vector<Candidate>& candidates, const NamingRules& rules, Discovery& discovery)
      : candidates_(candidates), rules_(rules), discovery_(discovery) {
    entry_.name = candidates.front().loop;
  }

  CatalogueEntry assign() {
    // Words of one role first: a shared word takes what they leave.
    for (const TagRole& role : kTagRoles) fill(role, of_role(role, false));
    for (const TagRole& role : kTagRoles) {
      if (!(entry_.*role.tag).empty()) continue;
      const auto shared = of_role(role, true);
      if (shared.empty()) continue;
      fill(role, shared);
      if (!(entry_.*role.tag).empty()) discovery_.by_shared_word.push_back(entry_.name);
    }
    return entry_;
  }

 private:
  using Ranked = std::vector<std::pair<std::size_t, const Candidate*>>;

  [[nodiscard]] bool is_shared(const std::string& word) const {
    return std::ranges::count_if(kTagRoles, [&](const TagRole& role) {
             return rank_of(rules_, role.name, word).has_value();
           }) > 1;
  }

  [[nodiscard]] bool is_taken(const std::string& tag) const {
    return std::ranges::any_of(kTagRoles,
                               [&](const TagRole& role) { return entry_.*role.tag == tag; });
  }

  [[nodiscard]] Ranked of_role(const TagRole& role, bool shared) const {
    Ranked ranked;
    for (const Candidate& candidate : candidates_) {
      if (is_shared(candidate.word) != shared || is_taken(candidate.tag)) continue;
      const auto rank = rank_of(rules_, role.name, candidate.word);
      if (rank) ranked.emplace_back(*rank, &candidate);
    }
    std::ranges::stable_sort(ranked, {}, [](const auto& one) { return one.first; });
    return ranked;
  }

  /// The preferred word decides; between tags of the same word nothing does.
  void fill(const TagRole& role, const Ranked& ranked) {
    if (ranked.empty()) return;
    const bool clear = ranked.size() == 1 || ranked[0].first != ranked[1].first;
    if (clear) entry_.*role.tag = ranked[0].second->tag;
    if (clear && role.name == "pv") entry_.name = ranked[0].second->loop;
    if (ranked.size() == 1) return;
    AmbiguousRole& ambiguous = discovery_.ambiguous.emplace_back();
    ambiguous.loop = entry_.name;
    ambiguous.role = role.name;
    ambiguous.taken = entry_.*role.tag;
    for (const auto& [rank, candidate] : ranked) ambiguous.tags.push_back(candidate->tag);
  }

  const std::vector<Candidate>& candidates_;
  const NamingRules& rules_;
  Discovery& discovery_;
  CatalogueEntry entry_;
};

}  // namespace

Discovery discover_loops(std::span<const std::string> tags, const NamingRules& rules) {
  Discovery discovery;
  const std::vector<std::string> words = rules.all_words();
  std::map<std::string, std::vector<Candidate>> loops;
  for (const std::string& tag : tags) {
    if (const auto found = match(tag, rules, words)) {
      loops[lower_case(found->loop)].push_back({tag, lower_case(found->word), found->loop});
    } else {
      discovery.unmatched.push_back(tag);
    }
  }
  for (const auto& [name, candidates] : loops) {
    CatalogueEntry entry = Loop(candidates, rules, discovery).assign();
    (entry.pv_tag.empty() ? discovery.without_pv : discovery.loops).push_back(std::move(entry));
  }
  return discovery;
}

}  // namespace loopscope::daemon
