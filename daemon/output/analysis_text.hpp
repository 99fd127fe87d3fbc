#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::daemon {

/// The diagnosis on one terminal page: verdict first, then the figures it rests on.
/// `sample_interval_s` turns bifrequencies into periods.
[[nodiscard]] std::string analysis_text(const std::string& title, double sample_interval_s,
                                        const core::Diagnosis& diagnosis);

}  // namespace loopscope::daemon
