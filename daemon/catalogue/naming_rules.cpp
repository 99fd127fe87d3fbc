#include "daemon/catalogue/naming_rules.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <stdexcept>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/split_list.hpp"

namespace loopscope::daemon {
namespace {

/// Patterns may hold commas.
constexpr char kBetweenPatterns = ';';

constexpr const char* kPatternHint =
    "e.g. {loop}.{role} for FIC101.PV, {loop}[./_]{role}, {loop}/*/{role}.CV";
constexpr const char* kRoleHint = "e.g. --role pv=PV,MEAS; roles are sp, pv, op, mv and mode";

TagPattern read_pattern(const std::string& text, ExitCode whose) {
  try {
    return TagPattern(text);
  } catch (const std::invalid_argument& problem) {
    throw Failure(whose, fmt::format("pattern \"{}\": {}", text, problem.what()), kPatternHint);
  }
}

/// Who says how a site names a role means it: nothing else is taken for that role.
void replace_words(NamingRules& rules, std::string_view role, std::string_view list) {
  for (NamingConvention& convention : rules.conventions) convention.set(role, list);
}

void set_role(NamingRules& rules, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string role = lower_case(trimmed(std::string_view(text).substr(0, equals)));
  if (equals == std::string::npos || !rules.conventions.front().words.contains(role)) {
    throw Failure(ExitCode::usage, fmt::format("--role \"{}\" is not ROLE=WORD,WORD", text),
                  kRoleHint);
  }
  replace_words(rules, role, std::string_view(text).substr(equals + 1));
}

struct RoleWords {
  const char* role;
  std::string config::DiscoverySettings::*list;
};
constexpr RoleWords kRoleWords[] = {{"sp", &config::DiscoverySettings::sp_words},
                                    {"pv", &config::DiscoverySettings::pv_words},
                                    {"op", &config::DiscoverySettings::op_words},
                                    {"mv", &config::DiscoverySettings::mv_words},
                                    {"mode", &config::DiscoverySettings::mode_words}};

void set_words(NamingRules& rules, const config::DiscoverySettings& settings) {
  const config::DiscoverySettings defaults;
  rules.conventions = vendor_conventions();
  rules.conventions.insert(rules.conventions.begin(), NamingConvention{"the settings' words"});
  for (const auto& [role, list] : kRoleWords) {
    rules.conventions.front().set(role, settings.*list);
    if (settings.*list != defaults.*list) replace_words(rules, role, settings.*list);
  }
}

}  // namespace

std::vector<std::string> NamingRules::all_words() const {
  std::set<std::string> each;
  for (const NamingConvention& convention : conventions)
    for (const auto& [role, spelled] : convention.spelled)
      each.insert(spelled.begin(), spelled.end());
  std::vector<std::string> all(each.begin(), each.end());
  std::ranges::stable_sort(all, std::ranges::greater{}, &std::string::size);
  return all;
}

PlainWords NamingRules::plain_words() const {
  PlainWords all;
  for (const NamingConvention& convention : conventions)
    for (const auto& [role, spelled] : convention.spelled)
      for (const std::string& word : spelled) all.insert(plain_word(word));
  return all;
}

NamingRules naming_rules(const config::DiscoverySettings& settings,
                         const std::vector<std::string>& patterns,
                         const std::vector<std::string>& roles) {
  NamingRules rules;
  for (const std::string& text : patterns)
    rules.patterns.push_back(read_pattern(text, ExitCode::usage));
  if (patterns.empty()) {
    for (const std::string_view text : split_list(settings.patterns, kBetweenPatterns))
      rules.patterns.push_back(read_pattern(std::string(text), ExitCode::configuration));
  }
  set_words(rules, settings);
  for (const std::string& role : roles) set_role(rules, role);
  return rules;
}

}  // namespace loopscope::daemon
