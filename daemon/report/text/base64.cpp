#include "daemon/report/text/base64.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>

namespace loopscope::daemon {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t k) -> std::uint32_t {
    return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U;
  };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::uint32_t group = byte(k) << 16U | byte(k + 1) << 8U | byte(k + 2);
    text += kDigits[group >> 18U];
    text += kDigits[group >> 12U & 63U];
    text += k + 1 < bytes.size() ? kDigits[group >> 6U & 63U] : '=';
    text += k + 2 < bytes.size() ? kDigits[group & 63U] : '=';
  }
  return text;
}

std::string csp_hash(std::string_view sha256_hex) {
  std::string digest;
  for (std::size_t k = 0; k + 1 < sha256_hex.size(); k += 2) {
    unsigned value = 0;
    std::from_chars(sha256_hex.data() + k, sha256_hex.data() + k + 2, value, 16);
    digest += static_cast<char>(value);
  }
  return "'sha256-" + base64(digest) + "'";
}

}  // namespace loopscope::daemon
