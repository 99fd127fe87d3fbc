#include "daemon/commands/program.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "config/read_settings.hpp"
#include "daemon/commands/unknown_word.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

int report(ExitCode code, const std::string& what, const std::string& hint) {
  std::cout.flush();
  std::cerr << "error: " << printable(what) << '\n';
  if (!hint.empty()) std::cerr << "HINT: " << printable(hint) << '\n';
  return static_cast<int>(code);
}

/// All problems, a line each, then all hints.
int report_settings(const config::SettingsError& error) {
  std::cout.flush();
  std::string hints;
  for (const config::Problem& problem : error.problems()) {
    const std::string place = problem.path.empty() ? "" : printable(problem.path) + ": ";
    const char* start = &problem == &error.problems().front() ? "error: " : "";
    std::cerr << start << printable(error.file()) << ": " << place << printable(problem.message)
              << '\n';
    if (!problem.hint.empty()) hints += "HINT: " + place + printable(problem.hint) + '\n';
  }
  if (hints.empty()) hints = "HINT: loopscope check-config --describe lists every setting\n";
  std::cerr << hints;
  return static_cast<int>(ExitCode::configuration);
}

/// CLI11 also ends --help and --version by an exception: those print and leave with 0.
int report_usage(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return program.exit(error);
  if (const auto unknown = find_unknown_word(program))
    return report(ExitCode::usage, unknown->what, unknown->hint);
  return report(ExitCode::usage, error.what(), "see loopscope --help, loopscope COMMAND --help");
}

/// A full disk behind a redirected standard output must not pass for success.
void require_written_output() {
  if (std::cout.flush()) return;
  throw Failure(ExitCode::usage, "standard output could not be written",
                "check the disk or the program behind the pipe");
}

}  // namespace

int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands) {
  CLI::App program{"Loopscope tells a plant why its control loops perform poorly.", "loopscope"};
  program.set_version_flag("--version", "loopscope " LOOPSCOPE_VERSION);
  program.require_subcommand(1);
  for (const AddCommand add : commands) add(program);
  try {
    program.parse(argc, argv);
    require_written_output();
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::ParseError& error) {
    return report_usage(program, error);
  } catch (const Failure& failure) {
    return report(failure.exit_code(), failure.what(), failure.hint());
  } catch (const config::SettingsError& error) {
    return report_settings(error);
  } catch (const storage::DatabaseError& error) {
    return report(ExitCode::database, error.what(), error.hint());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::fault, "out of memory", "give the program more, or fewer workers");
  } catch (const std::exception& error) {
    return report(ExitCode::fault, error.what(),
                  "this is a fault in the program: please report it");
  }
}

}  // namespace loopscope::daemon
