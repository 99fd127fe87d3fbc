#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace loopscope::daemon {

/// Actions of `loopscope loops` with options of their own; `config` names the settings file once
/// the command line was read.
void add_discover(CLI::App& loops, const std::shared_ptr<const std::string>& config);
void add_check(CLI::App& loops, const std::shared_ptr<const std::string>& config);

}  // namespace loopscope::daemon
