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
constexpr std::size_t kShownDeadEnds = 50;

std::vector<bool> ask(const config::Settings& settings, const std::string& source,
                      std::span<const std::string> tags) {
  const config::HistorianSettings& historian = find_historian(settings, source);
  storage::HistorianReader reader(historian_connection(historian), historian_layout(historian));
  return have_rows(reader, tags);
}

void print(const TagCheck& check) {
  for (std::size_t k = 0; k < std::min(check.dead_ends.size(), kShownDeadEnds); ++k) {
    const DeadEnd& end = check.dead_ends[k];
    std::cout << fmt::format("{:<28} {:<5} {:<32} {}: {}\n", printable(end.loop), end.role,
                             printable(end.tag), end.source, end.problem);
  }
  if (check.dead_ends.size() > kShownDeadEnds) {
    std::cout << fmt::format("... and {} more: --out FILE.csv has them all\n",
                             check.dead_ends.size() - kShownDeadEnds);
  }
}

/// Of all enabled loops, by source; `changed` has the entries that something can be filled into.
std::vector<Proposal> proposals_for(const config::Settings& settings,
                                    std::span<const storage::CatalogueEntry> entries,
                                    std::vector<storage::CatalogueEntry>& changed) {
  std::map<std::string, std::vector<storage::CatalogueEntry>> by_source;
  for (const storage::CatalogueEntry& entry : entries)
    if (entry.enabled) by_source[entry.source].push_back(entry);
  std::vector<Proposal> all;
  for (auto& [source, loops] : by_source) {
    const config::HistorianSettings& historian = find_historian(settings, source);
    storage::HistorianReader reader(historian_connection(historian), historian_layout(historian));
    const std::vector<LoopValues> values = read_values(reader, loops);
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

void tell_proposals(const CheckOptions& options, const config::Settings& settings,
                    std::span<const storage::CatalogueEntry> entries) {
  std::vector<storage::CatalogueEntry> changed;
  const std::vector<Proposal> proposals = proposals_for(settings, entries, changed);
  // A CSV may go to standard output: nothing else must get into it.
  std::ostream& told = options.out == "-" || options.propose == "-" ? std::cerr : std::cout;
  told << proposals_text(proposals);
  if (!options.propose.empty()) write_csv(options.propose, catalogue_csv(changed));
  if (changed.empty() || options.propose == "-") return;
  told << (options.propose.empty()
               ? fmt::format("--propose FILE.csv writes {} with what is proposed\n",
                             core::text::counted(changed.size(), "loop", "loops"))
               : fmt::format("review {0}, then: loopscope loops --config {1} load {0}\n",
                             printable(options.propose), printable(*options.config)));
}

void check(const CheckOptions& options) {
  const config::Settings settings = config::read_settings(*options.config);
  const auto entries = storage::Catalogue(owner_connection(settings)).list();
  const TagCheck found =
      check_tags(entries, [&](const std::string& source, std::span<const std::string> tags) {
        return ask(settings, source, tags);
      });
  if (options.out != "-") print(found);
  tell_proposals(options, settings, entries);
  if (!options.out.empty()) write_csv(options.out, dead_ends_csv(found));
  if (!found.dead_ends.empty()) {
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{} of {} of {} cannot be found", found.dead_ends.size(),
                              core::text::counted(found.tags, "tag", "tags"),
                              core::text::counted(found.loops, "loop", "loops")),
                  "correct them with loopscope loops set or load; loops discover shows what the "
                  "historian has");
  }
  if (options.out == "-") return;
  std::cout << fmt::format("{} of {}, all with rows\n",
                           core::text::counted(found.tags, "tag", "tags"),
                           core::text::counted(found.loops, "loop", "loops"));
}

}  // namespace

void add_check(CLI::App& loops, const std::shared_ptr<const std::string>& config) {
  CLI::App& command = *loops.add_subcommand(
      "check",
      "Lists every tag of the catalogue that its historian does not have, and proposes ranges and "
      "types by history and name");
  command.fallthrough();
  const auto options = std::make_shared<CheckOptions>();
  options->config = config;
  command.add_option("--out", options->out, "CSV to write, - for standard output");
  command.add_option("--propose", options->propose,
                     "CSV for `loops load` to write: loops with the ranges and types that history "
                     "and names propose");
  command.callback([options] { check(*options); });
}

}  // namespace loopscope::daemon
