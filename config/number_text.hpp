#pragma once

#include <string>

namespace loopscope::config {

/// A number as a person writes it: 0.0001 and 86400, not 1e-04 and 86400.0; 15 digits.
[[nodiscard]] std::string number_text(double value);

}  // namespace loopscope::config
