#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/catalogue/select_loops.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/catalogue/delete_loops.hpp"

namespace loopscope::daemon {
namespace {

using core::text::counted;
using storage::LoopsDeletion;

struct DeleteOptions {
  std::shared_ptr<const std::string> config;
  std::vector<std::string> names;
  bool with_results = false;
};

/// "431 analyses, 2 annotations, 1 piece of maintenance work".
std::string results_text(const LoopsDeletion& deletion) {
  return fmt::format("{}, {}, {} of maintenance work",
                     counted(deletion.analyses, "analysis", "analyses"),
                     counted(deletion.annotations, "annotation", "annotations"),
                     counted(deletion.maintenance_events, "piece", "pieces"));
}

void require_deleted(const LoopsDeletion& deletion) {
  if (!deletion.held.empty()) {
    std::string names;
    for (const std::string& name : deletion.held) names += (names.empty() ? "" : ", ") + name;
    throw Failure(ExitCode::usage,
                  fmt::format("nothing was deleted: being analysed at this moment: {}", names),
                  "try again in some seconds; loopscope loops disable keeps workers from them");
  }
  if (deletion.deleted) return;
  throw Failure(ExitCode::usage,
                fmt::format("nothing was deleted: {} of {} {} results ({})", deletion.with_results,
                            counted(deletion.loops, "loop", "loops"),
                            deletion.with_results == 1 ? "has" : "have", results_text(deletion)),
                "--with-results deletes them too, for ever; loopscope loops disable keeps them");
}

void delete_named(const DeleteOptions& options) {
  const config::Settings settings = config::read_settings(*options.config);
  const storage::ConnectionSettings connection = owner_connection(settings);
  std::vector<std::string> names;
  for (const storage::CatalogueEntry& entry :
       select_loops(storage::Catalogue(connection).list(), options.names))
    names.push_back(entry.name);
  const LoopsDeletion deletion = storage::delete_loops(connection, names, options.with_results);
  require_deleted(deletion);
  for (const std::string& name : names) std::cout << fmt::format("deleted {}\n", printable(name));
  std::cout << fmt::format("{} deleted, with {}\n", counted(deletion.loops, "loop", "loops"),
                           results_text(deletion));
}

}  // namespace

void add_delete(CLI::App& loops, const std::shared_ptr<const std::string>& config) {
  CLI::App& command = *loops.add_subcommand("delete", "Deletes loops, all or none");
  command.fallthrough();
  const auto options = std::make_shared<DeleteOptions>();
  options->config = config;
  command.add_option("NAME", options->names, "Loops by name, or by pattern, e.g. 'FIC-*'")
      ->required();
  command.add_flag("--with-results", options->with_results,
                   "Also loops with analyses, annotations or maintenance work, which go with them");
  command.callback([options] { delete_named(*options); });
}

}  // namespace loopscope::daemon
