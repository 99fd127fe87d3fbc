#include "daemon/recording/recording_form.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

#include "config/nearest_name.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

Failure columns_failure(const std::string& what, const std::string& hint = {}) {
  return {ExitCode::usage, "--columns: " + what,
          hint.empty() ? "e.g. --columns time=Zeitstempel,pv=PV_Actual,sp=W,op=Y" : hint};
}

/// The pieces between commas, those without "=" put back behind the one before.
std::vector<std::string> pairs_of(std::string_view text) {
  std::vector<std::string> pairs;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string piece(text.substr(0, comma));
    if (piece.find('=') == std::string::npos && !pairs.empty())
      pairs.back() += "," + piece;
    else
      pairs.push_back(piece);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return pairs;
}

std::string known_role(std::string_view word) {
  const auto* const found = std::ranges::find_if(
      kColumnRoles, [&](std::string_view role) { return same_word(role, word); });
  if (found != kColumnRoles.end()) return std::string(*found);
  const std::vector<std::string> roles(kColumnRoles.begin(), kColumnRoles.end());
  const auto nearest = config::nearest_name(word, roles);
  throw columns_failure(fmt::format("no column of a recording is called \"{}\"", word),
                        nearest ? fmt::format("did you mean \"{}\"?", *nearest)
                                : fmt::format("one of {}", fmt::join(roles, ", ")));
}

}  // namespace

std::map<std::string, std::string, std::less<>> parse_columns(std::string_view text) {
  std::map<std::string, std::string, std::less<>> columns;
  for (const std::string& pair : pairs_of(text)) {
    const std::size_t sign = pair.find('=');
    const std::string_view name =
        sign == std::string::npos ? "" : trimmed(std::string_view(pair).substr(sign + 1));
    if (name.empty())
      throw columns_failure(fmt::format("\"{}\" is not ROLE=NAME of a column", pair));
    const std::string role = known_role(trimmed(std::string_view(pair).substr(0, sign)));
    if (!columns.emplace(role, name).second)
      throw columns_failure(fmt::format("\"{}\" stands twice", role));
  }
  return columns;
}

}  // namespace loopscope::daemon
