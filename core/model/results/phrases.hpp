#pragma once

#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
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

/// The parts in a row; numbers with three significant digits and a decimal point everywhere.
template <typename... Part>
[[nodiscard]] std::string sentence(const Part&... parts) {
  constexpr int kDigits = 3;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(kDigits);
  (text << ... << parts);
  return text.str();
}

/// A share of 0 to 1 in whole percent, e.g. "97".
[[nodiscard]] inline long whole_percent(double share) {
  return static_cast<long>(std::floor(100.0 * share + 0.5));
}

}  // namespace loopscope::core::model
