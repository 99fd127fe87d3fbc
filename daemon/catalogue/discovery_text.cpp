#include "daemon/catalogue/discovery_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text/counted.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/shell_word.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

/// As many of a kind are named; the CSV and the catalogue have the rest.
constexpr std::size_t kShown = 10;

/// "  5 without pv, left out: A, B, ...": nothing when there is none.
std::string line(const char* of_one, const char* of_more, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  const std::size_t shown = std::min(names.size(), kShown);
  std::string text = fmt::format("{:>8} {}: ", names.size(), names.size() == 1 ? of_one : of_more);
  for (std::size_t k = 0; k < shown; ++k) text += (k == 0 ? "" : ", ") + printable(names[k]);
  return text + (shown < names.size() ? ", ...\n" : "\n");
}

std::string line(const char* what, const std::vector<std::string>& names) {
  return line(what, what, names);
}

std::string tags_of(const CatalogueEntry& entry) {
  std::vector<std::string> tags;
  for (const TagRole& role : kTagRoles) {
    if (!(entry.*role.tag).empty()) tags.push_back(entry.*role.tag);
  }
  return fmt::format("{} ({})", entry.name, fmt::join(tags, ", "));
}

std::vector<std::string> without(const std::vector<CatalogueEntry>& loops,
                                 std::string CatalogueEntry::*tag) {
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : loops) {
    if ((entry.*tag).empty()) names.push_back(entry.name);
  }
  return names;
}

std::vector<std::string> texts_of(const std::vector<CatalogueEntry>& entries) {
  std::vector<std::string> texts;
  for (const CatalogueEntry& entry : entries) texts.push_back(tags_of(entry));
  return texts;
}

std::vector<std::string> doubtful_loops(const Discovery& discovery) {
  std::vector<std::string> texts;
  for (const DoubtfulLoop& loop : discovery.doubtful)
    texts.push_back(fmt::format("{}: {}", tags_of(loop.entry), loop.reason));
  return texts;
}

std::vector<std::string> ambiguous_roles(const Discovery& discovery) {
  std::vector<std::string> texts;
  for (const AmbiguousRole& role : discovery.ambiguous) {
    texts.push_back(fmt::format("{} {} ({}; {})", role.loop, role.role, fmt::join(role.tags, ", "),
                                role.taken.empty() ? "none taken" : "taken: " + role.taken));
  }
  return texts;
}

std::string roles_text(const std::vector<CatalogueEntry>& loops) {
  std::vector<std::string> counts;
  for (const TagRole& role : kTagRoles) {
    const auto count = std::ranges::count_if(
        loops, [&](const CatalogueEntry& entry) { return !(entry.*role.tag).empty(); });
    counts.push_back(fmt::format("{} {}", role.name, count));
  }
  return fmt::format("{}", fmt::join(counts, ", "));
}

std::vector<std::string> filled_in(const std::vector<Proposal>& proposals) {
  std::vector<std::string> texts;
  for (const Proposal& proposal : proposals) {
    if (proposal.apply != nullptr)
      texts.push_back(fmt::format("{} {} ({})", proposal.loop, proposal.fields, proposal.reason));
  }
  return texts;
}

/// With the commands that answer it, of which one is right.
std::string question_text(const Proposal& question, const std::string& config) {
  std::string text =
      printable(fmt::format("         {}: {}", question.loop, question.reason)) + '\n';
  for (const std::string& answer : question.answers) {
    text += printable(fmt::format("           loopscope loops --config {} set {} {}",
                                  shell_word(config), shell_word(question.loop), answer)) +
            '\n';
  }
  return text;
}

std::string questions_text(const std::vector<Proposal>& proposals, const std::string& config) {
  std::string text;
  std::size_t questions = 0;
  for (const Proposal& proposal : proposals) {
    if (proposal.apply == nullptr && questions++ < kShown) text += question_text(proposal, config);
  }
  if (questions == 0) return {};
  if (questions > kShown) text += fmt::format("         ... and {} more\n", questions - kShown);
  return fmt::format(
      "{:>8} {} that history leaves open; who knows the answer says it, once the loop "
      "is in the catalogue, by:\n{}",
      questions, questions == 1 ? "question" : "questions", text);
}

}  // namespace

std::string proposals_text(const std::vector<Proposal>& proposals, const std::string& config) {
  return line("proposed by history and name", filled_in(proposals)) +
         questions_text(proposals, config);
}

std::string discovery_text(const DiscoveryReport& report) {
  const Discovery& found = report.discovery;
  return fmt::format("historian {}: {}, {} new ({}), {} in the catalogue\n", report.source,
                     core::text::counted(report.tags, "tag", "tags"),
                     core::text::counted(found.loops.size(), "loop is", "loops are"),
                     roles_text(found.loops), core::text::counted(report.known, "is", "are")) +
         line("without pv, left out", texts_of(found.without_pv)) +
         line("pv without sp and op, no control loop, left out", texts_of(found.indicators)) +
         line("perhaps no control loop, left out", doubtful_loops(found)) +
         line("without op, no model and no valve to judge",
              without(found.loops, &CatalogueEntry::op_tag)) +
         line("without sp, the mean of pv stands in",
              without(found.loops, &CatalogueEntry::sp_tag)) +
         line("tag without a value, left out", "tags without a value, left out",
              report.empty_tags) +
         line("role with several tags", "roles with several tags", ambiguous_roles(found)) +
         line("by a word of two roles (MV), check op and mv", found.by_shared_word) +
         line("name taken by another loop of the catalogue, left out",
              "names taken by other loops of the catalogue, left out", report.taken) +
         line("tag is no loop's by its name", "tags are no loop's by their names",
              found.unmatched) +
         proposals_text(report.proposals, report.config);
}

}  // namespace loopscope::daemon
