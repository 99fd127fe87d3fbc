#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace loopscope::daemon {

struct HttpRequest {
  std::string path;                               ///< decoded, any bytes
  std::multimap<std::string, std::string> query;  ///< decoded names and values, any bytes
  std::string method = "GET";
  std::optional<std::string> host = {};             ///< as it was sent; none = HTTP/1.0 without one
  std::optional<std::string> accept_encoding = {};  ///< as it was sent; none = no such header
};

/// A request line and its headers together; browsers and proxies need a tenth of it.
inline constexpr std::size_t kMostHeadBytes = std::size_t{16} * 1024;
/// A loop's name of 1000 bytes, each written as %XX, and more.
inline constexpr std::size_t kMostTargetBytes = std::size_t{8} * 1024;

/// The status of a head that cannot be answered: 400 or 414.
using HttpRefusal = int;
inline constexpr HttpRefusal kTargetTooLong = 414;

/// Reads a head, everything up to the empty line. Nothing of a body is looked at: what is served
/// here takes none.
[[nodiscard]] std::variant<HttpRequest, HttpRefusal> parse_request(std::string_view head);

/// `%41` is A, and in a query + is a blank; a % that no two hexadecimal digits follow stays.
[[nodiscard]] std::string percent_decoded(std::string_view text, bool plus_is_blank);

}  // namespace loopscope::daemon
