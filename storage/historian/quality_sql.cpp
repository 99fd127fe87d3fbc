#include "storage/historian/quality_sql.hpp"

#include <charconv>
#include <cstdint>
#include <vector>

#include "storage/array_literal.hpp"
#include "storage/error.hpp"
#include "storage/historian/column_types.hpp"
#include "storage/historian/refuse.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

using Codes = std::vector<std::string>;

// OPC HDA: values that the server made up instead of reading them (OPC Historical Data Access 1.2,
// quality flags 0x00020000 interpolated, 0x00080000 calculated).
constexpr const char* kMadeUp = "655360";

/// OPC DA (Data Access 3.0, section 6.8): the two upper bits of the low byte; 0x80 is not used.
QualitySql opcda(const std::string& q, bool accept_uncertain) {
  const std::string major = "(" + q + " & 192)";
  return {accept_uncertain ? major + " IN (192, 64)" : major + " = 192", major + " <> 128"};
}

/// OPC UA (part 4, 7.38 StatusCode): bits 30 and 31, 3 is not used. Kept in four bytes the code is
/// negative when it is bad; the shift then brings copies of the sign, which the mask takes off.
/// Bits 10 and 11 = 1 say that the low two bits tell raw (0), calculated (1), interpolated (2).
QualitySql opcua(const std::string& q, bool accept_uncertain) {
  const std::string severity = "((" + q + "::int8 >> 30) & 3)";
  const std::string measured = "NOT ((" + q + " & 3072) = 1024 AND (" + q + " & 3) = 2)";
  return {severity + (accept_uncertain ? " IN (0, 1)" : " = 0") + " AND " + measured,
          severity + " <> 3"};
}

bool is_whole_number(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

/// `function` is what the database makes of every code: "lower", or "" for the code itself.
std::string in_list(const PqConnection& connection, const std::string& q, const Codes& codes,
                    const std::string& function = "") {
  std::string list;
  for (const std::string& code : codes) {
    list += (list.empty() ? "" : ", ") + function + "(" + connection.quote_literal(code) + ")";
  }
  return list.empty() ? "false" : q + " IN (" + list + ")";
}

/// The ids behind names: read once, so that no row has to be joined.
Codes ids_of(PqConnection& connection, const SourceLayout& layout, const SideTable& table,
             const Codes& names) {
  const auto found = find_relation(connection, split_relation(table.relation));
  if (!found) refuse(layout, "no such table: " + table.relation, "set `quality_table`");
  require_columns(
      layout, table.relation, found->types,
      {{"quality_name_column", table.name_column}, {"quality_id_column", table.id_column}});
  ArrayLiteral wanted;
  for (const std::string& name : names) wanted.add_text(name);
  const PqRows rows = connection.run(
      historian_statements::ids_of_names(found->sql, connection.quote(table.name_column),
                                         connection.quote(table.id_column)),
      {wanted.text()});
  Codes ids;
  for (int row = 0; row < rows.size(); ++row) ids.push_back(rows.text(row, 0));
  return ids;
}

QualitySql listed(PqConnection& connection, const SourceLayout& layout, const std::string& column,
                  const std::string& type) {
  const QualityDecoder& rule = layout.quality;
  Codes good = rule.good;
  if (rule.accept_uncertain) good.insert(good.end(), rule.uncertain.begin(), rule.uncertain.end());
  Codes known = good;
  for (const Codes* more : {&rule.uncertain, &rule.bad}) {
    known.insert(known.end(), more->begin(), more->end());
  }
  if (rule.names) {
    good = ids_of(connection, layout, *rule.names, good);
    known = ids_of(connection, layout, *rule.names, known);
    if (good.empty()) {
      refuse(layout, rule.names->relation + " has none of the names in `good_codes`",
             "set `good_codes` to names as they stand in " + rule.names->relation);
    }
  }
  const bool numbers = !is_text_type(type);
  for (const std::string& code : known) {
    if (numbers && !is_whole_number(code)) {
      refuse(layout, "the quality code \"" + code + "\" is not a number, but the column is " + type,
             "write codes as the column has them, or name `quality_table`");
    }
  }
  if (numbers) return {in_list(connection, column, good), in_list(connection, column, known)};
  const std::string word = "lower(btrim(" + column + "::text))";
  return {in_list(connection, word, good, "lower"), in_list(connection, word, known, "lower")};
}

}  // namespace

QualitySql quality_sql(PqConnection& connection, const SourceLayout& layout,
                       const std::string& column, const std::string& type) {
  const QualityRule rule = layout.quality.rule;
  const bool whole = type == "int2" || type == "int4" || type == "int8";
  const bool fits = rule == QualityRule::truth   ? type == "bool"
                    : rule == QualityRule::codes ? whole || is_text_type(type)
                                                 : whole;
  if (!fits) {
    refuse(layout,
           "column " + column + " has the type " + type + ", which `quality_rule` cannot read",
           "set `quality_rule` to truth for boolean columns, to codes for texts");
  }
  const bool uncertain = layout.quality.accept_uncertain;
  switch (rule) {
    case QualityRule::none:
      return {};
    case QualityRule::opcda:
      return opcda(column, uncertain);
    case QualityRule::opcda_exact:
      return {column + " = 192", column + " IS NOT NULL"};
    case QualityRule::opcua:
      return opcua(column, uncertain);
    case QualityRule::opchda: {
      QualitySql sql = opcda(column, uncertain);
      sql.good += " AND (" + column + " & " + kMadeUp + ") = 0";
      return sql;
    }
    case QualityRule::zero:
      return {column + " = 0", column + " IS NOT NULL"};
    case QualityRule::truth:
      return {column, column + " IS NOT NULL"};
    case QualityRule::codes:
      return listed(connection, layout, column, type);
  }
  return {};
}

}  // namespace loopscope::storage
