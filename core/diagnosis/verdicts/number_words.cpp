#include "core/diagnosis/verdicts/number_words.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace loopscope::core::diagnosis {
std::string tuning_waits() {
  return " Do not retune before that is repaired.";
}

std::string p_text(double p) {
  constexpr double kLeast = 1e-12;
  constexpr int kDigits = 2;
  if (p < kLeast) return "< 1e-12";
  std::array<char, 32> text{};
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), p, std::chars_format::general, kDigits);
  return {text.data(), result.ptr};
}

std::string p_equals(double p) {
  const std::string text = p_text(p);
  return (text.front() == '<' ? "p " : "p = ") + text;
}

}  // namespace loopscope::core::diagnosis
