#pragma once

#include <string>

#include "core/model/results/phrases.hpp"

namespace loopscope::core::diagnosis {

/// A number with three significant digits, for reasons that an engineer reads.
[[nodiscard]] inline std::string number(double value) {
  return model::in_digits(value);
}

/// A p-value with two significant digits; "< 1e-12" where the digits say nothing any more, since
/// they rest on tails that no record is long enough to show.
[[nodiscard]] std::string p_text(double p);

/// "p = 0.03", "p < 1e-12".
[[nodiscard]] std::string p_equals(double p);

/// A share as a whole percentage, e.g. "12 %".
[[nodiscard]] inline std::string percent(double share) {
  return model::in_percent(share);
}

/// A period in the unit that an engineer would say it in: "45 s", "12.5 min", "3.2 h".
[[nodiscard]] inline std::string duration(double seconds) {
  return model::in_time(seconds);
}

/// What is added to the action for a valve or sensor fault: tuning waits.
[[nodiscard]] std::string tuning_waits();

}  // namespace loopscope::core::diagnosis
