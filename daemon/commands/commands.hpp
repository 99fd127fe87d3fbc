#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace loopscope::daemon {

/// Each adds one subcommand with its options and the callback that carries it out. Callbacks
/// throw Failure, config::SettingsError, storage::DatabaseError or CLI errors; main maps them to
/// exit codes.
void add_run(CLI::App& program);
void add_once(CLI::App& program);
void add_backfill(CLI::App& program);
void add_analyze(CLI::App& program);
void add_import(CLI::App& program);
void add_loops(CLI::App& program);
void add_maintenance(CLI::App& program);
void add_window(CLI::App& program);
void add_report(CLI::App& program);
void add_replay(CLI::App& program);
void add_annotate(CLI::App& program);
void add_export(CLI::App& program);
void add_init(CLI::App& program);
void add_migrate(CLI::App& program);
void add_maintain(CLI::App& program);
void add_check_config(CLI::App& program);

/// Actions of `loopscope loops` with options of their own; `config` names the settings file once
/// the command line was read.
void add_discover(CLI::App& loops, const std::shared_ptr<const std::string>& config);
void add_check(CLI::App& loops, const std::shared_ptr<const std::string>& config);
void add_delete(CLI::App& loops, const std::shared_ptr<const std::string>& config);

}  // namespace loopscope::daemon
