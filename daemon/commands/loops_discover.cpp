#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <set>
#include <utility>

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
#include "storage/historian/list_tags.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

struct DiscoverOptions {
  std::shared_ptr<const std::string> config;
  std::string source;
  std::vector<std::string> patterns;
  std::vector<std::string> roles;
  std::string out;
  bool add = false;
};

const config::HistorianSettings& source_of(const DiscoverOptions& options,
                                           const config::Settings& settings) {
  return options.source.empty() ? settings.historians.front()
                                : find_historian(settings, options.source);
}

/// Leaves what the catalogue does not have yet, with what a loop has that is added without more.
void keep_new(const std::vector<CatalogueEntry>& stored, double period_s, DiscoveryReport& report) {
  std::set<std::string> names, pv_tags;
  for (const CatalogueEntry& entry : stored) {
    names.insert(entry.name);
    if (entry.source == report.source) pv_tags.insert(entry.pv_tag);
  }
  std::vector<CatalogueEntry> fresh;
  for (CatalogueEntry& entry : report.discovery.loops) {
    entry.source = report.source;
    entry.period_s = period_s;
    if (pv_tags.contains(entry.pv_tag)) {
      ++report.known;
    } else if (names.contains(entry.name)) {
      report.taken.push_back(entry.name);
    } else {
      fresh.push_back(std::move(entry));
    }
  }
  report.discovery.loops = std::move(fresh);
}

/// What history and names tell of the new loops.
void look_at_history(const config::HistorianSettings& source, DiscoveryReport& report) {
  std::vector<CatalogueEntry>& loops = report.discovery.loops;
  if (loops.empty()) return;
  storage::HistorianReader reader(historian_connection(source), historian_layout(source));
  const TagCheck found =
      check_tags(loops, [&](const std::string&, std::span<const std::string> tags) {
        return newest_rows(reader, tags);
      });
  drop_dead_ends(found, loops);
  for (const CheckedTag& tag : found.tags)
    if (!tag.newest_us && tag.role != "pv") report.empty_tags.push_back(tag.tag);
  const std::vector<LoopValues> values = read_values(reader, loops);
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const std::vector<Proposal> proposals = propose(loops[k], values[k]);
    fill_in(proposals, loops[k]);
    report.proposals.insert(report.proposals.end(), proposals.begin(), proposals.end());
  }
}

void require_something(const DiscoveryReport& report) {
  if (!report.discovery.loops.empty() || report.known > 0) return;
  throw Failure(ExitCode::unusable_data,
                fmt::format("no loop was found among {} of historian {}",
                            core::text::counted(report.tags, "tag", "tags"), report.source),
                "say how the site names them: --pattern '{loop}.{role}', --role pv=PV,MEAS; "
                "/discovery keeps it in the settings");
}

void put_out(const DiscoverOptions& options, const DiscoveryReport& report,
             storage::Catalogue& catalogue) {
  const std::vector<CatalogueEntry>& loops = report.discovery.loops;
  // The CSV may go to standard output: the report must not get into it.
  (options.out == "-" ? std::cerr : std::cout) << discovery_text(report);
  require_something(report);
  if (options.add) {
    std::cout << core::text::counted(catalogue.save(loops).added, "loop", "loops") + " added\n";
  } else if (!options.out.empty()) {
    write_csv(options.out, catalogue_csv(loops));
    if (options.out == "-") return;
    if (loops.empty()) {
      std::cout << "nothing new: " << printable(options.out) << " has no loop to load\n";
      return;
    }
    std::cout << fmt::format("review {0}, then: loopscope loops --config {1} load {0}\n",
                             printable(options.out), printable(*options.config));
  } else {
    std::cout << "nothing written: --out FILE.csv to review first, --add for the catalogue\n";
  }
}

void discover(const DiscoverOptions& options) {
  const config::Settings settings = config::read_settings(*options.config);
  const NamingRules rules = naming_rules(settings.discovery, options.patterns, options.roles);
  const config::HistorianSettings& source = source_of(options, settings);
  storage::Catalogue catalogue(owner_connection(settings));
  const std::vector<std::string> tags =
      storage::list_tags(historian_connection(source), historian_layout(source));
  DiscoveryReport report;
  report.source = source.name;
  report.config = *options.config;
  report.tags = tags.size();
  report.discovery = discover_loops(tags, rules);
  keep_new(catalogue.list(), settings.schedule.default_period_s, report);
  look_at_history(source, report);
  put_out(options, report, catalogue);
}

}  // namespace

void add_discover(CLI::App& loops, const std::shared_ptr<const std::string>& config) {
  CLI::App& command =
      *loops.add_subcommand("discover", "Finds loops among the tags of a historian by their names");
  command.fallthrough();
  const auto options = std::make_shared<DiscoverOptions>();
  options->config = config;
  command.add_option("--source", options->source, "Historian of the settings (default: the first)");
  command.add_option("--pattern", options->patterns,
                     "How tags are named, e.g. {loop}.{role}; may be given several times "
                     "(default: /discovery/patterns)");
  command.add_option("--role", options->roles,
                     "Words for a role, e.g. pv=PV,MEAS; may be given several times "
                     "(default: /discovery/..._words)");
  CLI::Option* out = command.add_option("--out", options->out,
                                        "CSV for `loops load` to write, - for standard output");
  command.add_flag("--add", options->add, "Add the loops to the catalogue")->excludes(out);
  command.callback([options] { discover(*options); });
}

}  // namespace loopscope::daemon
