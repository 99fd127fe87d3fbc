#include "storage/results/schema/past_months.hpp"

#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// As far back as the months that end after the retention: those are dropped as a whole.
const Statement kKeptFrom{"kept_from", R"(
    SELECT $1::timestamptz >= first.day AT TIME ZONE 'UTC' OR $2::integer = 0 AS kept,
           CASE WHEN $2::integer > 0 THEN to_char(first.day, 'YYYY-MM-DD') ELSE '' END AS kept_from
    FROM (SELECT date_trunc('month', (now() - make_interval(months => $2::integer))
                                       AT TIME ZONE 'UTC') AS day) AS first)",
                          Rows::one};

const Statement kMissingMonths{"missing_months", R"(
    SELECT to_char(month.day, 'YYYY-MM') AS month
    FROM generate_series(date_trunc('month', $1::timestamptz AT TIME ZONE 'UTC'),
                         now() AT TIME ZONE 'UTC', interval '1 month') AS month (day)
    WHERE EXISTS (
      SELECT FROM unnest(ARRAY['analysis', 'bicoherence_peak', 'explanation_step', 'verdict'])
        AS parent (name)
      WHERE to_regclass(format('loopscope.%I', parent.name
                                                 || to_char(month.day, '_YYYY_MM'))) IS NULL)
    ORDER BY month.day)"};

}  // namespace

PastMonths past_months(const ConnectionSettings& settings, std::int64_t since_us,
                       int retention_months) {
  Session session(settings);
  require_schema_version(session);
  const std::string since = timestamp_text(since_us);
  return session.transact([&](Transaction& transaction) {
    PastMonths months;
    const pqxx::row kept = transaction.run(kKeptFrom, {since, std::to_string(retention_months)})[0];
    months.kept = kept["kept"].as<bool>();
    months.kept_from = read_text(kept["kept_from"]);
    for (const pqxx::row& row : transaction.run(kMissingMonths, {since}))
      months.missing.push_back(read_text(row["month"]));
    return months;
  });
}

}  // namespace loopscope::storage
