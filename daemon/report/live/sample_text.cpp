#include "daemon/report/live/sample_text.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <vector>

#include "daemon/report/text/base64.hpp"

namespace loopscope::daemon {
namespace {

using Singles = std::vector<float>;

float in_single_precision(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (!std::isfinite(value)) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

bool is_same(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

std::string in_runs(const Singles& values) {
  std::string text;
  for (auto begin = values.begin(); begin != values.end();) {
    const auto end =
        std::find_if(begin, values.end(), [&](float value) { return !is_same(value, *begin); });
    fmt::format_to(std::back_inserter(text), "{}{},{}", text.empty() ? '[' : ',', end - begin,
                   std::isnan(*begin) ? "null" : fmt::format("{}", *begin));
    begin = end;
  }
  return text.empty() ? "[]" : text + "]";
}

std::string quoted_base64(const std::string& bytes) {
  return '"' + base64(bytes) + '"';
}

std::string in_base64(const Singles& values) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (const unsigned shift : {0U, 8U, 16U, 24U})
      bytes += static_cast<char>(bits >> shift & 255U);
  }
  return quoted_base64(bytes);
}

}  // namespace

std::string sample_text(std::span<const double> samples) {
  Singles values;
  std::ranges::transform(samples, std::back_inserter(values), in_single_precision);
  std::string runs = in_runs(values);
  std::string singles = in_base64(values);
  return runs.size() < singles.size() ? runs : singles;
}

std::string presence_text(std::span<const double> samples) {
  constexpr std::size_t kBits = 8;
  std::string bytes((samples.size() + kBits - 1) / kBits, '\0');
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (std::isfinite(samples[k]))
      bytes[k / kBits] = static_cast<char>(bytes[k / kBits] | 1 << k % kBits);
  }
  return quoted_base64(bytes);
}

}  // namespace loopscope::daemon
