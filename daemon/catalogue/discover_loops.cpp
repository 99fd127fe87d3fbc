#include "daemon/catalogue/discover_loops.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/catalogue/group_tags.hpp"
#include "daemon/catalogue/instrument_name.hpp"
#include "daemon/catalogue/match_transmitters.hpp"

namespace loopscope::daemon {
namespace {

/// A group with its roles.
struct Named {
  TagGroup group;
  RoleAssignment roles;
  std::optional<InstrumentKind> kind;
  bool no_controller = false;  ///< a limit, a total, a block of inputs

  [[nodiscard]] bool has_pv() const { return !roles.entry.pv_tag.empty(); }
  /// Has sp or op, and no pv.
  [[nodiscard]] bool is_blind() const { return !has_pv() && roles.signals() > 0; }
  [[nodiscard]] bool is_controller() const { return kind == InstrumentKind::controller; }
};

std::vector<Named> named_groups(GroupedTags& grouped, const NamingRules& rules) {
  std::vector<Named> all;
  for (TagGroup& group : grouped.groups) {
    RoleAssignment roles = assign_roles(group.candidates, rules.conventions);
    Named named{std::move(group), std::move(roles), std::nullopt, false};
    if (rules.patterns.empty()) named.no_controller = names_no_controller(named.group.path);
    if (const auto name = instrument_name(named.group.path)) named.kind = name->letters.kind;
    all.push_back(std::move(named));
  }
  return all;
}

std::set<std::string> as_set(const std::vector<std::string>& tags) {
  return {tags.begin(), tags.end()};
}

using TagsByPath = std::map<std::string, std::vector<std::string>>;

/// The tag that stands under the controller's path, where there is one; several are ambiguous.
void take_only_one(const TagsByPath& tags, Named& one, std::vector<std::string>& taken) {
  const auto found = tags.find(one.group.path);
  if (found == tags.end()) return;
  if (found->second.size() == 1) {
    one.roles.entry.pv_tag = found->second.front();
    taken.push_back(found->second.front());
  } else {
    one.roles.ambiguous.push_back({one.roles.entry.name, "pv", found->second, ""});
  }
}

/// FIC101/AI1/PV for FIC101/PID1/OUT, where no other block has a pv. Returns the tags so taken.
std::vector<std::string> take_from_module(std::vector<Named>& all) {
  TagsByPath by_module;
  for (const Named& one : all) {
    const std::string_view module = before_last_part(one.group.path);
    const bool measures = one.has_pv() && (one.no_controller || one.roles.signals() == 1);
    if (measures && !module.empty())
      by_module[std::string(module)].push_back(one.roles.entry.pv_tag);
  }
  std::vector<std::string> taken;
  for (Named& one : all) {
    if (one.group.block.empty() || !one.is_blind()) continue;
    take_only_one(by_module, one, taken);
  }
  return taken;
}

/// FT-210 for FIC-210.SP and .OP. Returns the tags so taken.
std::vector<std::string> take_from_transmitters(std::vector<Named>& all,
                                                std::span<const std::string> unmatched) {
  Transmitters transmitters;
  for (const std::string& tag : unmatched)
    transmitters.add(tag.substr(0, without_endings(tag)), tag);
  std::vector<BlindController> controllers;
  for (Named& one : all) {
    if (one.has_pv() && one.roles.signals() == 1)
      transmitters.add(one.group.path, one.roles.entry.pv_tag);
    if (one.is_blind() && one.is_controller() && !one.no_controller)
      controllers.push_back({one.group.path, &one.roles});
  }
  return transmitters.give(controllers);
}

/// FIC101 or FIC101.Value for FIC101.SP and FIC101.OP. Returns the tags so taken.
std::vector<std::string> take_by_own_name(std::vector<Named>& all,
                                          std::span<const std::string> unmatched) {
  TagsByPath by_name;
  for (const std::string& tag : unmatched)
    by_name[lower_case(tag.substr(0, without_endings(tag)))].push_back(tag);
  std::vector<std::string> taken;
  for (Named& one : all) {
    if (!one.is_blind() || !one.is_controller()) continue;
    take_only_one(by_name, one, taken);
  }
  return taken;
}

/// Gives a pv to controllers that have none of their own. Returns the tags so taken.
std::set<std::string> take_measurements(std::vector<Named>& all,
                                        std::vector<std::string>& unmatched) {
  std::set<std::string> taken;
  taken.merge(as_set(take_by_own_name(all, unmatched)));
  taken.merge(as_set(take_from_module(all)));
  taken.merge(as_set(take_from_transmitters(all, unmatched)));
  std::erase_if(unmatched, [&](const std::string& tag) { return taken.contains(tag); });
  return taken;
}

/// Why it is perhaps no control loop; empty = it is one.
std::string doubt_of(const Named& one) {
  const bool complete = one.roles.signals() == 3;
  if (one.roles.convention->everyday) {
    if (!one.roles.one_shape) return "everyday words, not named alike";
    if (!complete && !one.is_controller()) return "everyday words, not sp, pv and op together";
  }
  if (one.kind == InstrumentKind::other) return "named as a valve or a relay";
  if (complete || one.is_controller()) return {};
  if (one.kind) return "named as a measurement";
  return one.roles.glued ? "not sp, pv and op together, and no mark before the word" : "";
}

/// Sorts what was found into the lists of a discovery.
class Sorter {
 public:
  Sorter(Discovery& discovery, bool own_patterns)
      : discovery_(discovery), own_patterns_(own_patterns) {}

  void sort(Named& one, const std::set<std::string>& taken) {
    const std::size_t signals = one.roles.signals();
    const bool only_everyday = signals == 1 && one.roles.convention->everyday;
    if (signals == 0 && !one.no_controller && !one.roles.ambiguous.empty())
      return keep_ambiguous(one);
    if (one.no_controller || signals == 0 || only_everyday) return leave(one, taken);
    if (!one.has_pv()) return without_pv(one);
    if (signals == 1) {
      if (!taken.contains(one.roles.entry.pv_tag))
        discovery_.indicators.push_back(std::move(one.roles.entry));
      return;
    }
    if (std::string doubt = own_patterns_ ? std::string() : doubt_of(one); !doubt.empty()) {
      discovery_.doubtful.push_back({std::move(one.roles.entry), std::move(doubt)});
      return;
    }
    if (one.roles.by_shared_word) discovery_.by_shared_word.push_back(one.roles.entry.name);
    keep_ambiguous(one);
    discovery_.loops.push_back(std::move(one.roles.entry));
  }

 private:
  void leave(const Named& one, const std::set<std::string>& taken) {
    for (const TagCandidate& candidate : one.group.candidates)
      if (!taken.contains(candidate.tag)) discovery_.unmatched.push_back(candidate.tag);
  }

  void without_pv(Named& one) {
    keep_ambiguous(one);
    discovery_.without_pv.push_back(std::move(one.roles.entry));
  }

  void keep_ambiguous(const Named& one) {
    discovery_.ambiguous.insert(discovery_.ambiguous.end(), one.roles.ambiguous.begin(),
                                one.roles.ambiguous.end());
  }

  Discovery& discovery_;
  bool own_patterns_;
};

}  // namespace

Discovery discover_loops(std::span<const std::string> tags, const NamingRules& rules) {
  GroupedTags grouped = group_tags(tags, rules);
  std::vector<Named> all = named_groups(grouped, rules);
  Discovery discovery;
  discovery.unmatched = std::move(grouped.unmatched);
  std::set<std::string> taken;
  if (rules.patterns.empty()) taken = take_measurements(all, discovery.unmatched);
  Sorter sorter(discovery, !rules.patterns.empty());
  for (Named& one : all) sorter.sort(one, taken);
  return discovery;
}

}  // namespace loopscope::daemon
