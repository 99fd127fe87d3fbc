#pragma once

#include <span>

#include "daemon/commands/program.hpp"

namespace loopscope::daemon {

/// Commands about signals whose nature is known, as daemon/commands/commands.hpp has those of a
/// plant. They make up a library of their own, loopscope_lab, which the daemon's does not know.
void add_reproduce(CLI::App& program);
void add_calibrate(CLI::App& program);
void add_simulate(CLI::App& program);

}  // namespace loopscope::daemon
