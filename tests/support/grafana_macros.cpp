#include "tests/support/grafana_macros.hpp"

#include <array>
#include <ctime>

namespace loopscope::tests {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// '2026-02-27T00:00:00Z'.
std::string time_literal(std::int64_t time_s) {
  const auto time = static_cast<std::time_t>(time_s);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  const std::size_t length =
      std::strftime(text.data(), text.size(), "'%Y-%m-%dT%H:%M:%SZ'", &parts);
  return {text.data(), length};
}

/// $__timeFilter(COLUMN), wherever it stands.
void expand_filters(std::string& statement, const std::string& range) {
  const std::string macro = "$__timeFilter(";
  for (std::size_t at = statement.find(macro); at != std::string::npos;
       at = statement.find(macro)) {
    const std::size_t begin = at + macro.size(), end = statement.find(')', begin);
    statement.replace(at, end + 1 - at, statement.substr(begin, end - begin) + range);
  }
}

}  // namespace

std::string expand_macros(std::string statement, std::int64_t from_s, std::int64_t to_s) {
  const std::string from = time_literal(from_s), to = time_literal(to_s);
  expand_filters(statement, " BETWEEN " + from + " AND " + to);
  replace_all(statement, "$__timeFrom()", from);
  replace_all(statement, "$__timeTo()", to);
  replace_all(statement, "$__unixEpochFrom()", std::to_string(from_s));
  replace_all(statement, "$__unixEpochTo()", std::to_string(to_s));
  return statement;
}

std::string with_variable(std::string statement, const std::string& variable,
                          const std::string& value) {
  std::string literal = value;
  replace_all(literal, "'", "''");
  replace_all(statement, "${" + variable + ":sqlstring}", "'" + literal + "'");
  return statement;
}

}  // namespace loopscope::tests
