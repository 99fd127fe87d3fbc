#pragma once

#include <cstddef>
#include <string>

namespace loopscope::core::model {

/// A number with three significant digits.
[[nodiscard]] std::string in_digits(double value);

/// A time in the unit that an engineer would say it in: "45 s", "12.5 min", "3.2 h".
[[nodiscard]] std::string in_time(double seconds);

/// "30.7 min into the window (sample 1840)".
[[nodiscard]] std::string at_place(std::size_t sample, double sample_interval_s);

/// A share as a whole percentage, "12 %".
[[nodiscard]] std::string in_percent(double share);

}  // namespace loopscope::core::model
