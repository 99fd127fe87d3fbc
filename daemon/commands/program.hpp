#pragma once

namespace loopscope::daemon {

/// The whole program: parses the command line, carries the command out and turns every error into
/// `error: what, where` with a `HINT:` line on standard error and its exit code (contract.md).
int run_program(int argc, const char* const* argv);

}  // namespace loopscope::daemon
