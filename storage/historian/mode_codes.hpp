#pragma once

#include <vector>

#include "core/signal/raw_series.hpp"

namespace loopscope::storage {

/// What the values of a historian's mode tags mean.
struct ModeCodes {
  std::vector<double> manual{0.0};
  std::vector<double> automatic{1.0};
  std::vector<double> cascade{2.0};
};

/// A mode tag's values as the numbers of core::signal::ControlMode; a value that has no meaning is
/// an unknown mode, a missing one stays missing.
void decode_modes(core::signal::RawSeries& rows, const ModeCodes& codes);

}  // namespace loopscope::storage
