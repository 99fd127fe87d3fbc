#pragma once

#include <cmath>
#include <locale>
#include <sstream>
#include <string>

namespace loopscope::core::model {

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
