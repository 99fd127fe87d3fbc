#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <map>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/catalogue/catalogue_csv.hpp"
#include "daemon/catalogue/check_tags.hpp"
#include "daemon/catalogue/discovery_text.hpp"
#include "daemon/catalogue/read_values.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/write_csv.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

struct CheckOptions {
  std::shared_ptr<const std::string> config;
  std::string out;
  std::string propose;
};

/// As many are listed on a terminal; --out has them all.
constexpr std::size_t kShownProblems = 50;

/// What a command asks of its historians, each of which is connected to once.
class Historians {
 public:
  explicit Historians(const config::Settings& settings) : settings_(settings) {}

  storage::HistorianReader& of(const std::string& source) {
    const auto known = readers_.find(source);
    if (known != readers_.end()) return known->second;
    const config::HistorianSettings& historian = find_historian(settings_, source);
    return readers_
        .emplace(source, storage::HistorianReader(historian_connection(historian),
                                                  historian_layout(historian)))
        .first->second;
  }

 private:
  const config::Settings& settings_;
  std::map<std::string, storage::HistorianReader> readers_;
};

void print(const TagCheck& check) {
  std::size_t shown = 0, more = 0;
  for (const CheckedTag& tag : check.tags) {
    const std::string problem = tag.problem();
    if (problem.empty()) continue;
    if (shown == kShownProblems) {
      ++more;
      continue;
    }
    if (shown++ == 0)
      std::cout << fmt::format("{:<28} {:<5} {:<32} {:>9}\n", "loop", "role", "tag", "age");
    const std::string age = tag.newest_us ? age_text(tag.age_s) : "-";
    std::cout << fmt::format("{:<28} {:<5} {:<32} {:>9} {}: {}\n", printable(tag.loop), tag.role,
                             printable(tag.tag), age, tag.source, problem);
  }
  if (more > 0) std::cout << fmt::format("... and {} more: --out FILE.csv has them all\n", more);
}

/// "newest row of plant: 12 s old", of each historian.
void print_newest(const TagCheck& check) {
  std::map<std::string, double> youngest_s;
  for (const CheckedTag& tag : check.tags) {
    if (!tag.newest_us) continue;
    const auto known = youngest_s.emplace(tag.source, tag.age_s).first;
    known->second = std::min(known->second, tag.age_s);
  }
  for (const auto& [source, age_s] : youngest_s) {
    std::cout << fmt::format("newest row of historian {}: {} old\n", source,
                             age_text(std::max(age_s, 0.0)));
  }
}

/// Of all enabled loops, by source; `changed` has the entries that something can be filled into.
std::vector<Proposal> proposals_for(Historians& historians,
                                    std::span<const storage::CatalogueEntry> entries,
                                    std::vector<storage::CatalogueEntry>& changed) {
  std::map<std::string, std::vector<storage::CatalogueEntry>> by_source;
  for (const storage::CatalogueEntry& entry : entries)
    if (entry.enabled) by_source[entry.source].push_back(entry);
  std::vector<Proposal> all;
  for (auto& [source, loops] : by_source) {
    const std::vector<LoopValues> values = read_values(historians.of(source), loops);
    for (std::size_t k = 0; k < loops.size(); ++k) {
      const std::vector<Proposal> proposals = propose(loops[k], values[k]);
      all.insert(all.end(), proposals.begin(), proposals.end());
      if (std::ranges::none_of(proposals, [](const Proposal& one) { return one.apply != nullptr; }))
        continue;
      fill_in(proposals, loops[k]);
      changed.push_back(std::move(loops[k]));
    }
  }
  return all;
}

void tell_proposals(const CheckOptions& options, Historians& historians,
                    std::span<const storage::CatalogueEntry> entries) {
  std::vector<storage::CatalogueEntry> changed;
  const std::vector<Proposal> proposals = proposals_for(historians, entries, changed);
  // A CSV may go to standard output: nothing else must get into it.
  std::ostream& told = options.out == "-" || options.propose == "-" ? std::cerr : std::cout;
  told << proposals_text(proposals, *options.config);
  if (!options.propose.empty()) write_csv(options.propose, catalogue_csv(changed));
  if (changed.empty() || options.propose == "-") return;
  told << (options.propose.empty()
               ? fmt::format("--propose FILE.csv writes {} with what is proposed\n",
                             core::text::counted(changed.size(), "loop", "loops"))
               : fmt::format("review {0}, then: loopscope loops --config {1} load {0}\n",
                             printable(options.propose), printable(*options.config)));
}

TagCheck checked(std::span<const storage::CatalogueEntry> entries, Historians& historians) {
  TagCheck check =
      check_tags(entries, [&](const std::string& source, std::span<const std::string> tags) {
        return newest_rows(historians.of(source), tags);
      });
  find_stopped(check, [&](const std::string& source, std::span<const std::string> tags) {
    return longest_gaps(historians.of(source), tags);
  });
  return check;
}

void require_rows(const TagCheck& check) {
  if (check.without_rows() == 0) return;
  throw Failure(ExitCode::unusable_data,
                fmt::format("{} of {} of {} cannot be found", check.without_rows(),
                            core::text::counted(check.tags.size(), "tag", "tags"),
                            core::text::counted(check.loops, "loop", "loops")),
                "correct them with loopscope loops set or load; loops discover shows what the "
                "historian has");
}

void check(const CheckOptions& options) {
  const config::Settings settings = config::read_settings(*options.config);
  const auto entries = storage::Catalogue(owner_connection(settings)).list();
  Historians historians(settings);
  const TagCheck found = checked(entries, historians);
  if (options.out != "-") print(found);
  tell_proposals(options, historians, entries);
  if (!options.out.empty()) write_csv(options.out, checked_tags_csv(found));
  if (options.out != "-") print_newest(found);
  require_rows(found);
  if (options.out == "-") return;
  std::cout << fmt::format(
      "{} of {}, all with rows{}\n", core::text::counted(found.tags.size(), "tag", "tags"),
      core::text::counted(found.loops, "loop", "loops"),
      found.stopped() == 0
          ? ""
          : fmt::format("; {} stopped", found.stopped() == 1
                                            ? "1 has"
                                            : std::to_string(found.stopped()) + " have"));
}

}  // namespace

void add_check(CLI::App& loops, const std::shared_ptr<const std::string>& config) {
  CLI::App& command = *loops.add_subcommand(
      "check",
      "Lists tags of the catalogue without a row, or whose rows have stopped, and proposes ranges "
      "and types by history and name");
  command.fallthrough();
  const auto options = std::make_shared<CheckOptions>();
  options->config = config;
  command.add_option(
      "--out", options->out,
      "CSV of every tag with the age of its newest row to write, - for standard output");
  command.add_option("--propose", options->propose,
                     "CSV for `loops load` to write: loops with the ranges and types that history "
                     "and names propose");
  command.callback([options] { check(*options); });
}

}  // namespace loopscope::daemon
