#include "storage/historian/value_sql.hpp"

#include "storage/array_literal.hpp"
#include "storage/historian/column_types.hpp"

namespace loopscope::storage {
namespace {

// At most 200 digits before the point, 100 after it and two in the exponent: every such text is
// within the range of a double, so that the cast cannot fail.
constexpr const char* kNumberPattern =
    R"('^[+-]?([0-9]{1,200}(\.[0-9]{0,100})?|\.[0-9]{1,100})([eE][+-]?[0-9]{1,2})?$')";

std::string text_sql(const PqConnection& connection, const std::string& column,
                     const std::vector<std::pair<std::string, double>>& states) {
  const std::string trimmed = "btrim(" + column + "::text)";
  std::string sql =
      "CASE WHEN " + trimmed + " ~ " + kNumberPattern + " THEN " + trimmed + "::float8";
  // The database knows the capitals of its own letters.
  for (const auto& [text, value] : states) {
    sql += " WHEN lower(" + trimmed + ") = lower(" + connection.quote_literal(text) + ") THEN " +
           number_text(value) + "::float8";
  }
  return sql + " END";
}

}  // namespace

std::string value_sql(const PqConnection& connection, const std::string& column,
                      const std::string& type,
                      const std::vector<std::pair<std::string, double>>& states) {
  if (is_text_type(type)) return text_sql(connection, column, states);
  // There is no direct way from boolean to double.
  if (type == "bool") return column + "::int4::float8";
  if (type != "numeric") return column + "::float8";
  return "CASE WHEN abs(" + column + ") < 1e300 AND (" + column + " = 0 OR abs(" + column +
         ") > 1e-300) THEN " + column + "::float8 END";
}

}  // namespace loopscope::storage
