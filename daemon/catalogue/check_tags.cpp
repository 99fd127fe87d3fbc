#include "daemon/catalogue/check_tags.hpp"

#include <map>
#include <set>
#include <tuple>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

using Silent = std::map<std::string, std::set<std::string>>;

std::map<std::string, std::set<std::string>> tags_by_source(
    std::span<const CatalogueEntry> entries) {
  std::map<std::string, std::set<std::string>> tags;
  for (const CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles) {
      if (!(entry.*role.tag).empty()) tags[entry.source].insert(entry.*role.tag);
    }
  }
  return tags;
}

/// Tags without a row, by source.
Silent silent_tags(std::span<const CatalogueEntry> entries, const HasRows& has_rows) {
  Silent silent;
  for (const auto& [source, tags] : tags_by_source(entries)) {
    const std::vector<std::string> asked(tags.begin(), tags.end());
    const std::vector<bool> answer = has_rows(source, asked);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (!answer[k]) silent[source].insert(asked[k]);
    }
  }
  return silent;
}

}  // namespace

TagCheck check_tags(std::span<const CatalogueEntry> entries, const HasRows& has_rows) {
  Silent silent = silent_tags(entries, has_rows);
  TagCheck check;
  check.loops = entries.size();
  for (const CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles) {
      const std::string& tag = entry.*role.tag;
      if (tag.empty()) continue;
      ++check.tags;
      if (!silent[entry.source].contains(tag)) continue;
      check.dead_ends.push_back(
          {entry.name, entry.source, role.name, tag, "the historian has no row of this tag"});
    }
  }
  return check;
}

void drop_dead_ends(const TagCheck& check, std::span<CatalogueEntry> entries) {
  std::set<std::tuple<std::string, std::string, std::string>> dead;
  for (const DeadEnd& end : check.dead_ends) dead.emplace(end.source, end.loop, end.tag);
  for (CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles) {
      std::string& tag = entry.*role.tag;
      if (role.name != "pv" && dead.contains({entry.source, entry.name, tag})) tag.clear();
    }
  }
}

std::string dead_ends_csv(const TagCheck& check) {
  std::string text = "loop,source,role,tag,problem\n";
  for (const DeadEnd& end : check.dead_ends) {
    text += csv_cell(end.loop) + ',' + csv_cell(end.source) + ',' + std::string(end.role) + ',' +
            csv_cell(end.tag) + ',' + csv_cell(end.problem) + '\n';
  }
  return text;
}

}  // namespace loopscope::daemon
