#include "daemon/monitor/http_request.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <charconv>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

namespace http = boost::beast::http;

constexpr HttpRefusal kBadRequest = 400;
constexpr unsigned kVersion11 = 11;

std::optional<std::string> field(const http::fields& fields, http::field name) {
  const auto found = fields.find(name);
  if (found == fields.end()) return std::nullopt;
  return std::string(found->value());
}

/// RFC 9112, 3.2: exactly one Host, which HTTP/1.0 may leave out.
bool names_its_host(const http::request<http::empty_body>& request) {
  const std::size_t hosts = request.count(http::field::host);
  return hosts == 1 || (hosts == 0 && request.version() < kVersion11);
}

HttpRequest read_request(const http::request<http::empty_body>& message) {
  const std::string target(message.target());
  const std::size_t path_end = std::min(target.find('?'), target.size());
  HttpRequest request;
  request.path = percent_decoded(std::string_view(target).substr(0, path_end), false);
  if (path_end < target.size())
    request.query = parse_pairs(std::string_view(target).substr(path_end + 1));
  request.method = std::string(message.method_string());
  request.host = field(message, http::field::host);
  request.accept_encoding = field(message, http::field::accept_encoding);
  for (const auto& line : message)
    request.headers.emplace_back(std::string(line.name_string()), std::string(line.value()));
  return request;
}

}  // namespace

std::vector<std::string> HttpRequest::values(std::string_view name) const {
  std::vector<std::string> found;
  for (const auto& [line_name, value] : headers) {
    if (same_word(line_name, name)) found.push_back(value);
  }
  return found;
}

std::optional<std::string> HttpRequest::only_value(std::string_view name) const {
  std::vector<std::string> found = values(name);
  return found.size() == 1 ? std::optional(std::move(found.front())) : std::nullopt;
}

std::multimap<std::string, std::string> parse_pairs(std::string_view text) {
  std::multimap<std::string, std::string> pairs;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const std::size_t name_end = std::min(pair.find('='), pair.size());
    const std::string_view value = pair.substr(std::min(pair.size(), name_end + 1));
    pairs.emplace(percent_decoded(pair.substr(0, name_end), true), percent_decoded(value, true));
  }
  return pairs;
}

std::string percent_decoded(std::string_view text, bool plus_is_blank) {
  constexpr int kHexadecimal = 16;
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned char byte = 0;
    const bool escape =
        text[i] == '%' && digits.size() == 2 &&
        std::from_chars(digits.data(), digits.data() + digits.size(), byte, kHexadecimal).ptr ==
            digits.data() + digits.size();
    if (escape) {
      decoded += static_cast<char>(byte);
      i += digits.size();
    } else {
      decoded += plus_is_blank && text[i] == '+' ? ' ' : text[i];
    }
  }
  return decoded;
}

std::variant<HttpRequest, HttpRefusal> parse_request(std::string_view head) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(kMostHeadBytes);
  parser.skip(true);  // a body is read by HttpConnection, where one is wanted
  boost::system::error_code error;
  parser.put(boost::asio::buffer(head.data(), head.size()), error);
  if (error || !parser.is_header_done()) return kBadRequest;
  const auto& message = parser.get();
  if (message.target().size() > kMostTargetBytes) return kTargetTooLong;
  if (!names_its_host(message)) return kBadRequest;
  return read_request(message);
}

}  // namespace loopscope::daemon
