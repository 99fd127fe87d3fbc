#include "daemon/catalogue/check_tags.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/signal/microseconds.hpp"
#include "core/text/phrases.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/csv_table.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

struct Newest {
  std::optional<std::int64_t> time_us;
  double age_s = 0.0, behind_s = 0.0;
};
/// By source and tag.
using NewestOf = std::map<std::string, std::map<std::string, Newest>>;

double seconds(std::int64_t span_us) {
  return static_cast<double>(span_us) / core::signal::kMicrosecondsPerSecond;
}

std::map<std::string, Newest> newest_of(const std::vector<std::string>& tags,
                                        const NewestRows& rows) {
  std::optional<std::int64_t> last;
  for (const auto& time : rows.of_tags) last = std::max(last, time);
  std::map<std::string, Newest> newest;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    const auto& time = rows.of_tags.at(k);
    newest[tags[k]] =
        time ? Newest{time, seconds(rows.now_us - *time), seconds(*last - *time)} : Newest{};
  }
  return newest;
}

NewestOf ask_for(std::span<const CatalogueEntry> entries, const AskNewest& ask) {
  std::map<std::string, std::set<std::string>> by_source;
  for (const CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles)
      if (!(entry.*role.tag).empty()) by_source[entry.source].insert(entry.*role.tag);
  }
  NewestOf newest;
  for (const auto& [source, of_source] : by_source) {
    const std::vector<std::string> tags(of_source.begin(), of_source.end());
    newest[source] = newest_of(tags, ask(source, tags));
  }
  return newest;
}

std::size_t count_if(const TagCheck& check, bool (*is)(const CheckedTag&)) {
  return static_cast<std::size_t>(std::ranges::count_if(check.tags, is));
}

/// Silent for longer than the loop's period: the last analysis saw no row of it, or the next will.
bool is_behind(const CheckedTag& tag) {
  return tag.newest_us && tag.behind_s > tag.period_s;
}

}  // namespace

std::string age_text(double age_s) {
  constexpr double kDay_s = 86'400.0;
  return age_s < 2.0 * kDay_s ? core::text::duration(age_s)
                              : fmt::format("{:.0f} d", std::floor(age_s / kDay_s));
}

std::string CheckedTag::problem() const {
  if (!newest_us) return "the historian has no row of this tag";
  if (!longest_gap_s) return {};
  return fmt::format("stopped: no row for {}, never more than {} before", age_text(behind_s),
                     age_text(*longest_gap_s));
}

std::size_t TagCheck::without_rows() const {
  return count_if(*this, [](const CheckedTag& tag) { return !tag.newest_us; });
}

std::size_t TagCheck::stopped() const {
  return count_if(*this, [](const CheckedTag& tag) { return tag.longest_gap_s.has_value(); });
}

TagCheck check_tags(std::span<const CatalogueEntry> entries, const AskNewest& ask) {
  const NewestOf newest = ask_for(entries, ask);
  TagCheck check;
  check.loops = entries.size();
  for (const CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles) {
      const std::string& tag = entry.*role.tag;
      if (tag.empty()) continue;
      const Newest& row = newest.at(entry.source).at(tag);
      check.tags.push_back({entry.name, entry.source, role.name, tag, entry.period_s, row.time_us,
                            row.age_s, row.behind_s, std::nullopt});
    }
  }
  return check;
}

void find_stopped(TagCheck& check, const AskGaps& ask) {
  constexpr double kBeyond = 2.0;
  std::map<std::string, std::map<std::string, std::optional<double>>> gaps;
  for (const CheckedTag& tag : check.tags)
    if (is_behind(tag)) gaps[tag.source][tag.tag] = std::nullopt;
  for (auto& [source, of_tags] : gaps) {
    std::vector<std::string> tags;
    for (const auto& [tag, gap] : of_tags) tags.push_back(tag);
    const auto answer = ask(source, tags);
    for (std::size_t k = 0; k < tags.size(); ++k) of_tags[tags[k]] = answer.at(k);
  }
  for (CheckedTag& tag : check.tags) {
    if (!is_behind(tag)) continue;
    const std::optional<double> gap = gaps[tag.source][tag.tag];
    if (gap && tag.behind_s > kBeyond * *gap) tag.longest_gap_s = gap;
  }
}

void drop_dead_ends(const TagCheck& check, std::span<CatalogueEntry> entries) {
  std::set<std::tuple<std::string, std::string, std::string>> dead;
  for (const CheckedTag& tag : check.tags)
    if (!tag.newest_us) dead.emplace(tag.source, tag.loop, tag.tag);
  for (CatalogueEntry& entry : entries) {
    for (const TagRole& role : kTagRoles) {
      std::string& tag = entry.*role.tag;
      if (role.name != "pv" && dead.contains({entry.source, entry.name, tag})) tag.clear();
    }
  }
}

std::string checked_tags_csv(const TagCheck& check) {
  std::string text = "loop,source,role,tag,newest_row,age_s,problem\n";
  for (const CheckedTag& tag : check.tags) {
    text += csv_cell(tag.loop) + ',' + csv_cell(tag.source) + ',' + std::string(tag.role) + ',' +
            csv_cell(tag.tag) + ',';
    text += tag.newest_us ? fmt::format("{},{:.0f}", format_time(*tag.newest_us), tag.age_s) : ",";
    text += ',' + csv_cell(tag.problem()) + '\n';
  }
  return text;
}

}  // namespace loopscope::daemon
