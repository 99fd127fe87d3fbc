#pragma once

#include <CLI/CLI.hpp>
#include <span>

namespace loopscope::daemon {

/// Adds a command with its options to the program, and what carries it out.
using AddCommand = void (*)(CLI::App& program);

/// The whole program: parses the command line, carries the command out and turns every error into
/// `error: what, where` with a `HINT:` line on standard error and its exit code (contract.md).
int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands);

}  // namespace loopscope::daemon
