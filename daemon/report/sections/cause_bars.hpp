#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// The causes that are probable at all as bars, with what weighed for and against each; empty where
/// none was weighed. Any nonlinearity is shown where it is the verdict.
[[nodiscard]] Markup cause_bars(const core::diagnosis::Verdict& verdict);

/// What weighed for something and against it, for a template: title and reasons of each that is not
/// empty.
[[nodiscard]] List weights(const std::vector<std::string>& in_favour,
                           const std::vector<std::string>& against);

}  // namespace loopscope::daemon
