#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace loopscope::daemon {

struct HttpRequest {
  std::string path;                               ///< decoded, any bytes
  std::multimap<std::string, std::string> query;  ///< decoded names and values, any bytes
  std::string method = "GET";
  std::optional<std::string> host = {};             ///< as it was sent; none = HTTP/1.0 without one
  std::optional<std::string> accept_encoding = {};  ///< as it was sent; none = no such header
  /// Every line of the head, name and value, in their order; for who has a reason to look.
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::string from = {};  ///< address of the peer of the connection, as text
  std::string body = {};  ///< of a form that somebody asked for (HttpRoutes::add_form), else empty

  /// The values of all lines of that name, letter case aside.
  [[nodiscard]] std::vector<std::string> values(std::string_view name) const;
  /// The value of the one line of that name; nullopt = there is none, or more than one.
  [[nodiscard]] std::optional<std::string> only_value(std::string_view name) const;
};

/// A request line and its headers together; browsers and proxies need a tenth of it.
inline constexpr std::size_t kMostHeadBytes = std::size_t{16} * 1024;
/// A loop's name of 1000 bytes, each written as %XX, and more.
inline constexpr std::size_t kMostTargetBytes = std::size_t{8} * 1024;

/// The status of a head that cannot be answered: 400 or 414.
using HttpRefusal = int;
inline constexpr HttpRefusal kTargetTooLong = 414;

/// Reads a head, everything up to the empty line. Nothing of a body is looked at here.
[[nodiscard]] std::variant<HttpRequest, HttpRefusal> parse_request(std::string_view head);

/// Pairs NAME=VALUE between &, as queries and forms have them, decoded.
[[nodiscard]] std::multimap<std::string, std::string> parse_pairs(std::string_view text);

/// `%41` is A, and in a query + is a blank; a % that no two hexadecimal digits follow stays.
[[nodiscard]] std::string percent_decoded(std::string_view text, bool plus_is_blank);

}  // namespace loopscope::daemon
