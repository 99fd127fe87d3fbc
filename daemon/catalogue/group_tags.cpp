#include "daemon/catalogue/group_tags.hpp"

#include <map>
#include <optional>
#include <utility>

#include "daemon/catalogue/instrument_name.hpp"

namespace loopscope::daemon {
namespace {

/// A module's own tags (block "") and those of its controllers' blocks.
using Blocks = std::map<std::string, std::vector<TagCandidate>>;
using Modules = std::map<std::string, Blocks>;

/// A stem as module and controller's block.
struct Stem {
  std::string_view module, block;
};

/// FIC101.PIDA is FIC101 and .PIDA, 41FIC20021_PIDA is 41FIC20021 and _PIDA. Where the module is no
/// instrument (PLC1.PID2) the block is part of the name.
Stem split_stem(std::string_view stem) {
  const std::string_view part = last_part(stem);
  const std::size_t soft = part.rfind('_');
  std::string_view module;
  if (is_controller_block(part)) {
    module = before_last_part(stem);
  } else if (soft != std::string_view::npos && is_controller_block(part.substr(soft + 1))) {
    module = stem.substr(0, stem.size() - (part.size() - soft));
  }
  const auto name = instrument_name(module);
  if (!name || !name->ends_path) return {stem, {}};
  return {module, stem.substr(module.size())};
}

void add_parts(const std::string& tag, const TagParts& parts, Modules& modules) {
  const Stem stem = split_stem(parts.stem);
  const std::string block = lower_case(stem.block);
  modules[lower_case(stem.module)][block].push_back(
      {tag, parts.word, std::string(stem.module), block + parts.behind, parts.glued});
}

/// One loop where the module has one controller at most. Takes the candidates out of `blocks`.
void add_module(const std::string& path, Blocks& blocks, std::vector<TagGroup>& groups) {
  const std::size_t controllers = blocks.size() - (blocks.contains("") ? 1 : 0);
  if (controllers > 1) {
    for (auto& [block, candidates] : blocks) {
      for (TagCandidate& candidate : candidates)
        candidate.loop = candidate.tag.substr(0, candidate.loop.size() + block.size());
      groups.push_back({path + block, {}, std::move(candidates)});
    }
    return;
  }
  TagGroup group{path, {}, {}};
  for (auto& [block, candidates] : blocks) {
    group.block = block;
    group.candidates.insert(group.candidates.end(), candidates.begin(), candidates.end());
  }
  groups.push_back(std::move(group));
}

/// Without the name space of OPC UA and its quotation marks: ns=3;s="FIC101" -> FIC101.
std::string short_name(const std::string& name) {
  const std::size_t end = name.find(";s=");
  if (!name.starts_with("ns=") || end == std::string::npos) return name;
  std::string text = name.substr(end + 3);
  std::erase(text, '"');
  return text.empty() ? name : text;
}

/// Where two name spaces have one name each keeps its own.
void shorten_names(std::vector<TagGroup>& groups) {
  std::map<std::string, int> count;
  for (const TagGroup& group : groups) ++count[short_name(group.path)];
  for (TagGroup& group : groups) {
    if (count[short_name(group.path)] > 1) continue;
    for (TagCandidate& candidate : group.candidates) candidate.loop = short_name(candidate.loop);
  }
}

GroupedTags by_name(std::span<const std::string> tags, const NamingRules& rules) {
  const PlainWords words = rules.plain_words();
  GroupedTags grouped;
  Modules modules;
  for (const std::string& tag : tags) {
    if (const auto parts = split_tag(tag, words)) {
      add_parts(tag, *parts, modules);
    } else {
      grouped.unmatched.push_back(tag);
    }
  }
  for (auto& [path, blocks] : modules) add_module(path, blocks, grouped.groups);
  shorten_names(grouped.groups);
  return grouped;
}

std::optional<TagMatch> match(const std::string& tag, const NamingRules& rules,
                              const std::vector<std::string>& words) {
  for (const TagPattern& pattern : rules.patterns) {
    if (auto found = pattern.match(tag, words)) return found;
  }
  return std::nullopt;
}

GroupedTags by_pattern(std::span<const std::string> tags, const NamingRules& rules) {
  const std::vector<std::string> words = rules.all_words();
  GroupedTags grouped;
  std::map<std::string, std::vector<TagCandidate>> loops;
  for (const std::string& tag : tags) {
    if (const auto found = match(tag, rules, words)) {
      loops[lower_case(found->loop)].push_back({tag, plain_word(found->word), found->loop, {}});
    } else {
      grouped.unmatched.push_back(tag);
    }
  }
  for (auto& [path, candidates] : loops)
    grouped.groups.push_back({path, {}, std::move(candidates)});
  return grouped;
}

}  // namespace

GroupedTags group_tags(std::span<const std::string> tags, const NamingRules& rules) {
  return rules.patterns.empty() ? by_name(tags, rules) : by_pattern(tags, rules);
}

}  // namespace loopscope::daemon
