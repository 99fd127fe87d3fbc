#pragma once

#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

/// Figures as sentences say them, with a decimal point whatever the locale. "inf" and "nan" are
/// written as such.
namespace loopscope::core::text {

/// Three significant digits: "0.0123", "1.23e+04".
[[nodiscard]] std::string number(double value);

/// Three significant digits as a display shows them: an exponent only from 1e7 on and for what is
/// small, "12300".
[[nodiscard]] std::string display_number(double value);

/// `decimals` digits behind the point, "0.50".
[[nodiscard]] std::string fixed(double value, int decimals);

/// A size in the unit of pv, whichever that is: "1 unit of pv", "0.8 units of pv".
[[nodiscard]] std::string units_of_pv(double value);

/// A p-value with two significant digits; "< 1e-12" where the digits say nothing any more, since
/// they rest on tails that no record is long enough to show.
[[nodiscard]] std::string p_text(double p);

/// "p = 0.03", "p < 1e-12".
[[nodiscard]] std::string p_equals(double p);

/// A time in seconds, in the unit that an engineer would say it in: "45 s", "12.5 min", "3.2 h".
[[nodiscard]] std::string duration(double seconds);

/// "30.7 min into the window (sample 1840)".
[[nodiscard]] std::string at_place(std::size_t sample, double sample_interval_s);

/// A share of 0 to 1 as a whole percentage, "12 %".
[[nodiscard]] std::string percent(double share);

/// A share of 0 to 1 in whole percent, 97.
[[nodiscard]] inline long whole_percent(double share) {
  return static_cast<long>(std::floor(100.0 * share + 0.5));
}

/// A code or the name of a figure as words: "valve stiction", "cycle period".
[[nodiscard]] std::string code_words(std::string_view code);

/// A part of a sentence as one of its own: "the gaps are long" is "The gaps are long."; empty
/// stays.
[[nodiscard]] std::string as_sentence(std::string_view part);

/// The parts in a row; numbers with three significant digits.
template <typename... Part>
[[nodiscard]] std::string sentence(const Part&... parts) {
  constexpr int kDigits = 3;
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(kDigits);
  (stream << ... << parts);
  return stream.str();
}

}  // namespace loopscope::core::text
