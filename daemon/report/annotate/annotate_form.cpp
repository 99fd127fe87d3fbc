#include "daemon/report/annotate/annotate_form.hpp"

#include <algorithm>
#include <charconv>

#include "daemon/monitor/http_request.hpp"
#include "daemon/text/cells.hpp"
#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

using Pairs = std::multimap<std::string, std::string>;

bool is_fair(const Pairs& pairs) {
  for (const auto& [name, value] : pairs) {
    if (pairs.count(name) > 1 || !storage::is_storable(value)) return false;
  }
  return true;
}

std::string value_of(const Pairs& pairs, const char* name) {
  const auto found = pairs.find(name);
  return found == pairs.end() ? std::string() : found->second;
}

/// As the one line that a browser makes of it.
std::string line_of(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\r' || c == '\n' || c == '\t'; }, ' ');
  return std::string(trimmed(text));
}

/// "" is 0.
std::optional<std::int64_t> parse_id(const std::string& text) {
  if (text.empty()) return 0;
  std::int64_t id = 0;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, id);
  return error == std::errc() && read == end && id > 0 ? std::optional(id) : std::nullopt;
}

}  // namespace

std::optional<AnnotateForm> read_annotate_form(const std::string& body) {
  const Pairs pairs = parse_pairs(body);
  const std::optional<std::int64_t> id = parse_id(value_of(pairs, "annotation"));
  if (!is_fair(pairs) || !id) return std::nullopt;
  AnnotateForm form{value_of(pairs, "token"), value_of(pairs, "name"), {}, *id};
  form.typed.deed = value_of(pairs, "deed");
  form.typed.code = value_of(pairs, "code");
  form.typed.reason = line_of(value_of(pairs, "reason"));
  form.typed.until = line_of(value_of(pairs, "until"));
  return form;
}

}  // namespace loopscope::daemon
