#include <CLI/CLI.hpp>
#include <array>

#include "daemon/commands/commands.hpp"
#include "daemon/commands/program.hpp"
#include "daemon/lab/commands/commands.hpp"
#include "daemon/service/threads/memory.hpp"

namespace {

using namespace loopscope::daemon;

/// In the order of `loopscope --help`.
constexpr auto kCommands = std::to_array<AddCommand>(
    {add_run, add_once, add_backfill, add_analyze, add_reproduce, add_calibrate, add_simulate,
     add_import, add_loops, add_maintenance, add_window, add_report, add_replay, add_annotate,
     add_export, add_init, add_migrate, add_maintain, add_check_config});

}  // namespace

int main(int argc, char** argv) {
  bound_thread_caches();
  return run_program(argc, argv, kCommands);
}
