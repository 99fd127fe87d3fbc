#include "daemon/catalogue/naming_rules.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <stdexcept>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

/// Patterns may hold commas, words may not hold semicolons: each list has its own separator.
constexpr char kBetweenPatterns = ';';
constexpr char kBetweenWords = ',';

constexpr const char* kPatternHint =
    "e.g. {loop}.{role} for FIC101.PV, {loop}[./_]{role}, {loop}/*/{role}.CV";
constexpr const char* kRoleHint = "e.g. --role pv=PV,MEAS; roles are sp, pv, op, mv and mode";

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view part = trimmed(text.substr(0, end));
    if (!part.empty()) parts.emplace_back(part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

TagPattern read_pattern(const std::string& text, ExitCode whose) {
  try {
    return TagPattern(text);
  } catch (const std::invalid_argument& problem) {
    throw Failure(whose, fmt::format("pattern \"{}\": {}", text, problem.what()), kPatternHint);
  }
}

void set_words(NamingRules& rules, std::string_view role, std::string_view list) {
  std::vector<std::string> words;
  for (const std::string& word : split(list, kBetweenWords)) words.push_back(lower_case(word));
  rules.words[std::string(role)] = std::move(words);
}

void set_role(NamingRules& rules, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string role = lower_case(trimmed(std::string_view(text).substr(0, equals)));
  if (equals == std::string::npos || !rules.words.contains(role)) {
    throw Failure(ExitCode::usage, fmt::format("--role \"{}\" is not ROLE=WORD,WORD", text),
                  kRoleHint);
  }
  set_words(rules, role, std::string_view(text).substr(equals + 1));
}

}  // namespace

std::vector<std::string> NamingRules::all_words() const {
  std::set<std::string> each;
  for (const auto& [role, list] : words) each.insert(list.begin(), list.end());
  std::vector<std::string> all(each.begin(), each.end());
  std::ranges::stable_sort(all, std::ranges::greater{}, &std::string::size);
  return all;
}

NamingRules naming_rules(const config::DiscoverySettings& settings,
                         const std::vector<std::string>& patterns,
                         const std::vector<std::string>& roles) {
  NamingRules rules;
  const bool given = !patterns.empty();
  for (const std::string& text : given ? patterns : split(settings.patterns, kBetweenPatterns)) {
    rules.patterns.push_back(read_pattern(text, given ? ExitCode::usage : ExitCode::configuration));
  }
  set_words(rules, "sp", settings.sp_words);
  set_words(rules, "pv", settings.pv_words);
  set_words(rules, "op", settings.op_words);
  set_words(rules, "mv", settings.mv_words);
  set_words(rules, "mode", settings.mode_words);
  for (const std::string& role : roles) set_role(rules, role);
  return rules;
}

}  // namespace loopscope::daemon
