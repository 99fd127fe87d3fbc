#include "core/model/results/phrases.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace loopscope::core::model {
namespace {

std::string general(double value, int digits) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::general, digits);
  return {text.data(), result.ptr};
}

}  // namespace

std::string in_digits(double value) {
  constexpr int kDigits = 3;
  return general(value, kDigits);
}

std::string in_time(double seconds) {
  constexpr double kMinute_s = 60.0;
  constexpr double kHour_s = 3600.0;
  if (seconds >= 2.0 * kHour_s) return in_digits(seconds / kHour_s) + " h";
  if (seconds >= 2.0 * kMinute_s) return in_digits(seconds / kMinute_s) + " min";
  return in_digits(seconds) + " s";
}

std::string at_place(std::size_t sample, double sample_interval_s) {
  return in_time(static_cast<double>(sample) * sample_interval_s) + " into the window (sample " +
         std::to_string(sample) + ")";
}

std::string in_percent(double share) {
  constexpr int kDigits = 4;  // "1234 %" and still no exponent
  return general(std::round(100.0 * share), kDigits) + " %";
}

}  // namespace loopscope::core::model
