#pragma once

#include <span>
#include <string>

#include "core/diagnosis/verdict.hpp"

namespace loopscope::daemon {

/// The causes that are probable at all as bars, with what weighed for and against each, as HTML;
/// empty where none was weighed.
[[nodiscard]] std::string cause_bars(std::span<const core::diagnosis::CauseReport> causes);

}  // namespace loopscope::daemon
