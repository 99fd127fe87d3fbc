#include "storage/results/writes/analysis_statements.hpp"

#include <string_view>

#include "storage/array_literal.hpp"
#include "storage/results/writes/analysis_columns.hpp"

namespace loopscope::storage {
namespace {

/// The worker may not change these.
bool is_key(std::string_view column) {
  return column == "loop_id" || column == "slot_end" || column == "algorithm_revision";
}

/// Who made the row, from what, and in what time; and what it tells the next window, which rows of
/// before schema 106 do not say.
bool is_provenance(std::string_view column) {
  return column == "fence" || column == "program_version" || column == "settings" ||
         column == "input_digest" || column.ends_with("_ms") || column == "pv_flat_s" ||
         column == "pv_step";
}

/// A column as the statements see it.
struct Carried {
  std::string_view name, type, cast;
};

std::vector<Carried> columns_of_records() {
  std::vector<Carried> columns;
  for (const AnalysisColumn& column : analysis_columns())
    columns.push_back({column.name, column.type, column.cast});
  return columns;
}

/// What the windows up to a slot say together is no measurement of the slot.
std::vector<Carried> columns_of_rows() {
  std::vector<Carried> columns = columns_of_records();
  for (const std::string_view name :
       {"combined_probabilities", "combined_evidence", "combined_windows"})
    columns.push_back({name, "text", "::real[]"});
  return columns;
}

std::string joined(const std::vector<Carried>& columns, auto text_of) {
  std::string list;
  for (const Carried& column : columns) {
    const std::string text = text_of(column);
    if (!text.empty()) list += (list.empty() ? "" : ", ") + text;
  }
  return list;
}

std::string names_of(const std::vector<Carried>& columns) {
  return joined(columns, [](const Carried& column) { return std::string(column.name); });
}

/// The rows that the parameters carry, as they are stored.
std::string select_sql(const std::vector<Carried>& columns) {
  int parameter = 0;
  const std::string arrays = joined(columns, [&](const Carried& column) {
    return "$" + std::to_string(++parameter) + "::" + std::string(column.type) + "[]";
  });
  const std::string selected = joined(columns, [](const Carried& column) {
    return std::string(column.name) + std::string(column.cast) + " AS " + std::string(column.name);
  });
  return "SELECT " + selected + " FROM unnest(" + arrays + ") AS row (" + names_of(columns) + ")";
}

std::string upsert_sql() {
  const std::vector<Carried> columns = columns_of_rows();
  const std::string updates = joined(columns, [](const Carried& column) {
    const std::string name(column.name);
    return is_key(name) ? std::string() : name + " = EXCLUDED." + name;
  });
  return "INSERT INTO loopscope.analysis AS stored (" + names_of(columns) + ") " +
         select_sql(columns) +
         " ON CONFLICT (loop_id, slot_end, algorithm_revision) DO UPDATE SET " + updates +
         ", input_revision = stored.input_revision + 1, analysed_at = now()"
         // The fence keeps a late worker from putting older findings over newer ones.
         " WHERE stored.input_digest <> EXCLUDED.input_digest AND stored.fence <= EXCLUDED.fence"
         " RETURNING loop_id, (extract(epoch FROM slot_end) * 1000000)::bigint AS slot_end_us,"
         " input_revision, analysis_id";
}

}  // namespace

const Statement& upsert_analyses() {
  static const Statement statement{"upsert_analyses", upsert_sql(), Rows::any, Kept::plan};
  return statement;
}

std::string measured_object(const std::string& row) {
  return "to_jsonb(" + row +
         ") - "
         "'{analysis_id,input_revision,analysed_at,combined_probabilities,combined_evidence,"
         "combined_windows," +
         joined(columns_of_records(),
                [](const Carried& column) {
                  return is_key(column.name) || is_provenance(column.name)
                             ? std::string(column.name)
                             : std::string();
                }) +
         "}'::text[]";
}

const Statement& measure_analyses() {
  static const Statement statement{"measure_analyses",
                                   "SELECT " + measured_object("measured") + " FROM (" +
                                       select_sql(columns_of_records()) + ") AS measured"};
  return statement;
}

std::vector<std::string> analysis_parameters(const std::vector<const CompletedLoop*>& loops) {
  std::vector<std::string> parameters;
  for (const AnalysisColumn& column : analysis_columns()) {
    ArrayLiteral array;
    for (const CompletedLoop* loop : loops) column.add(array, *loop);
    parameters.push_back(array.text());
  }
  return parameters;
}

std::vector<std::string> upsert_parameters(const std::vector<const CompletedLoop*>& loops,
                                           const std::vector<std::optional<Combined>>& combined) {
  ArrayLiteral probabilities, evidence, windows;
  for (const std::optional<Combined>& loop : combined) {
    const Combined together = loop.value_or(Combined{});
    probabilities.add_real_list(together.probabilities);
    evidence.add_real_list(together.odds.evidence);
    windows.add_real_list(together.odds.windows);
  }
  std::vector<std::string> parameters = analysis_parameters(loops);
  for (const ArrayLiteral* array : {&probabilities, &evidence, &windows})
    parameters.push_back(array->text());
  return parameters;
}

}  // namespace loopscope::storage
