#include "daemon/monitor/form_head.hpp"

#include <charconv>
#include <optional>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kLength = "Content-Length";
constexpr const char* kCoding = "Transfer-Encoding";

/// Digits alone.
std::optional<std::size_t> parse_length(const std::string& text) {
  std::size_t length = 0;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, length);
  return error == std::errc() && read == end ? std::optional(length) : std::nullopt;
}

/// Without what may stand behind it, such as a charset.
bool is_form(const HttpRequest& request) {
  const auto type = request.only_value("Content-Type");
  return type &&
         same_word(trimmed(type->substr(0, type->find(';'))), "application/x-www-form-urlencoded");
}

std::variant<std::size_t, HttpAnswer> form_length(const HttpRequest& request) {
  const std::vector<std::string> lengths = request.values(kLength);
  const bool coded = !request.values(kCoding).empty();
  if (lengths.size() > 1 || (coded && !lengths.empty()))
    return HttpAnswer{400, "nothing was entered: how long the form is has to be said once\n"};
  if (lengths.empty())
    return HttpAnswer{411, "nothing was entered: a form has to say how long it is\n"};
  const auto length = parse_length(lengths.front());
  if (!length)
    return HttpAnswer{400, "nothing was entered: how long the form is has to be said in digits\n"};
  if (*length > kMostFormBytes)
    return HttpAnswer{413,
                      "nothing was entered: the form is longer than 8 kB\n"
                      "HINT: go back: what you typed stands there still; shorten it\n"};
  return *length;
}

}  // namespace

std::variant<FormHead, HttpAnswer> read_form_head(const HttpRequest& request) {
  const auto length = form_length(request);
  if (const auto* refusal = std::get_if<HttpAnswer>(&length)) return *refusal;
  if (!is_form(request))
    return HttpAnswer{415,
                      "nothing was entered: only application/x-www-form-urlencoded is "
                      "read, as a page's form sends it\n"};
  const std::vector<std::string> expected = request.values("Expect");
  if (expected.empty()) return FormHead{std::get<std::size_t>(length), false};
  if (expected.size() > 1 || !same_word(expected.front(), "100-continue"))
    return HttpAnswer{417, "nothing but 100-continue can be expected here\n"};
  return FormHead{std::get<std::size_t>(length), true};
}

}  // namespace loopscope::daemon
