#include "core/text/phrases.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace loopscope::core::text {
namespace {

constexpr int kDigits = 3;

std::string in_format(double value, std::chars_format format, int digits) {
  std::array<char, 400> text{};  // the largest number without an exponent has 309 digits
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
  return {text.data(), end.ptr};
}

}  // namespace

std::string number(double value) {
  return in_format(value, std::chars_format::general, kDigits);
}

std::string display_number(double value) {
  std::string text = number(value);
  double rounded = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  if (!(std::abs(rounded) >= 1e3) || std::abs(rounded) >= 1e7) return text;
  return fixed(rounded, 0);
}

std::string fixed(double value, int decimals) {
  return in_format(value, std::chars_format::fixed, decimals);
}

std::string units_of_pv(double value) {
  std::string text = number(value);
  text += text == "1" ? " unit of pv" : " units of pv";
  return text;
}

std::string p_text(double p) {
  constexpr double kLeast = 1e-12;
  constexpr int kDigitsOfP = 2;
  if (p < kLeast) return "< 1e-12";
  return in_format(p, std::chars_format::general, kDigitsOfP);
}

std::string p_equals(double p) {
  const std::string text = p_text(p);
  return (text.front() == '<' ? "p " : "p = ") + text;
}

std::string duration(double seconds) {
  constexpr double kMinute_s = 60.0;
  constexpr double kHour_s = 3600.0;
  if (seconds >= 2.0 * kHour_s) return number(seconds / kHour_s) + " h";
  if (seconds >= 2.0 * kMinute_s) return number(seconds / kMinute_s) + " min";
  return number(seconds) + " s";
}

std::string at_place(std::size_t sample, double sample_interval_s) {
  return duration(static_cast<double>(sample) * sample_interval_s) + " into the window (sample " +
         std::to_string(sample) + ")";
}

std::string percent(double share) {
  constexpr int kDigitsOfPercent = 4;  // "1234 %" and still no exponent
  return in_format(std::round(100.0 * share), std::chars_format::general, kDigitsOfPercent) + " %";
}

std::string code_words(std::string_view code) {
  std::string words(code);
  for (std::size_t k = 0; k < words.size(); ++k) {
    const bool part_follows = k + 1 < words.size() && words[k + 1] >= 'a' && words[k + 1] <= 'z';
    if (words[k] == '_' || (words[k] == '.' && part_follows)) words[k] = ' ';
  }
  return words;
}

std::string as_sentence(std::string_view part) {
  if (part.empty()) return {};
  constexpr std::array<std::string_view, 4> kSignals{"sp", "pv", "op", "mv"};
  std::string whole(part);
  const bool is_signal =
      std::ranges::find(kSignals, part.substr(0, part.find(' '))) != kSignals.end();
  if (!is_signal && whole.front() >= 'a' && whole.front() <= 'z') {
    whole.front() = static_cast<char>(whole.front() - 'a' + 'A');
  }
  return whole + ".";
}

}  // namespace loopscope::core::text
