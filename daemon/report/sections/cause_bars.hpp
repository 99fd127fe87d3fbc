#pragma once

#include <string>

#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::daemon {

/// The causes that are probable at all as bars, with what weighed for and against each, as HTML;
/// empty where none was weighed. Any nonlinearity is shown where it is the verdict.
[[nodiscard]] std::string cause_bars(const core::diagnosis::Verdict& verdict);

}  // namespace loopscope::daemon
