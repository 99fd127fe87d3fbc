#include "storage/historian/setup/historian_survey.hpp"

#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {
namespace {

// No index may serve the newest row of a whole table.
constexpr int kPatience_s = 8;
constexpr const char* kQueryCanceled = "57014";

// A row a column.
const Statement kTables{"historian_tables", R"(
    SELECT n.nspname, c.relname, pg_catalog.pg_get_userbyid(c.relowner),
           has_schema_privilege(n.oid, 'USAGE') AND has_any_column_privilege(c.oid, 'SELECT'),
           c.reltuples, a.attname, CASE WHEN t.typtype = 'd' THEN base.typname ELSE t.typname END,
           coalesce(pg_catalog.col_description(c.oid, a.attnum), '')
    FROM pg_catalog.pg_class AS c
    JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    JOIN pg_catalog.pg_attribute AS a ON a.attrelid = c.oid AND a.attnum > 0 AND NOT a.attisdropped
    JOIN pg_catalog.pg_type AS t ON t.oid = a.atttypid
    LEFT JOIN pg_catalog.pg_type AS base ON base.oid = t.typbasetype
    WHERE c.relkind IN ('r', 'p', 'v', 'm', 'f') AND NOT c.relispartition
      AND n.nspname NOT IN ('pg_catalog', 'information_schema', 'loopscope')
      AND n.nspname !~ '^(pg_|_?timescaledb)'
      AND NOT EXISTS (SELECT FROM pg_catalog.pg_inherits AS i WHERE i.inhrelid = c.oid)
    ORDER BY n.nspname, c.relname, a.attnum)"};

Statement sample_of(const std::string& relation, const std::string& column) {
  return {"historian_sample",
          "SELECT x.v::text, count(*) FROM (SELECT h." + column + " AS v FROM " + relation +
              " AS h LIMIT 20000) AS x WHERE x.v IS NOT NULL GROUP BY 1 ORDER BY 2 DESC, 1"
              " LIMIT 50"};
}

Statement behind_utc(const std::string& relation, const std::string& column) {
  return {"historian_behind_utc", "SELECT extract(epoch FROM (now() AT TIME ZONE 'UTC') - max(h." +
                                      column + ")) FROM " + relation + " AS h"};
}

}  // namespace

struct HistorianSurvey::Impl {
  explicit Impl(const ConnectionSettings& settings) : connection(settings) {}

  [[nodiscard]] std::string relation(const SeenTable& table) const {
    return connection.quote(table.schema) + "." + connection.quote(table.name);
  }

  PqConnection connection;
};

HistorianSurvey::HistorianSurvey(const ConnectionSettings& settings) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kPatience_s;
  impl_ = std::make_unique<Impl>(reader);
}

HistorianSurvey::~HistorianSurvey() = default;
HistorianSurvey::HistorianSurvey(HistorianSurvey&&) noexcept = default;
HistorianSurvey& HistorianSurvey::operator=(HistorianSurvey&&) noexcept = default;

std::vector<SeenTable> HistorianSurvey::tables() {
  const PqRows rows = impl_->connection.run(kTables);
  std::vector<SeenTable> tables;
  for (int row = 0; row < rows.size(); ++row) {
    const std::string schema = rows.text(row, 0), name = rows.text(row, 1);
    if (tables.empty() || tables.back().schema != schema || tables.back().name != name) {
      tables.push_back({schema,
                        name,
                        rows.text(row, 2),
                        rows.text(row, 3) == "t",
                        std::stod(rows.text(row, 4)),
                        {}});
    }
    tables.back().columns.push_back({rows.text(row, 5), rows.text(row, 6), rows.text(row, 7)});
  }
  return tables;
}

CountedTexts HistorianSurvey::sample(const SeenTable& table, const std::string& column) {
  const PqRows rows =
      impl_->connection.run(sample_of(impl_->relation(table), impl_->connection.quote(column)));
  CountedTexts texts;
  for (int row = 0; row < rows.size(); ++row)
    texts.emplace_back(rows.text(row, 0), std::stoll(rows.text(row, 1)));
  return texts;
}

std::optional<double> HistorianSurvey::seconds_behind_utc(const SeenTable& table,
                                                          const std::string& column) {
  try {
    const PqRows rows =
        impl_->connection.run(behind_utc(impl_->relation(table), impl_->connection.quote(column)));
    if (rows.is_null(0, 0)) return std::nullopt;
    return std::stod(rows.text(0, 0));
  } catch (const DatabaseError& error) {
    if (error.sqlstate() == kQueryCanceled) return std::nullopt;
    throw;
  }
}

}  // namespace loopscope::storage
