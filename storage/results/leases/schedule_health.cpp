#include "storage/results/leases/schedule_health.hpp"

#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

// A loop in the hands of a living worker has visible_at in the future, as one that is not due yet:
// so whoever is visible waits: behind the watermark of the claims, or as a suspect anywhere. The
// partitioned tables are those of the catalogue, because the
// worker may not call the owner's function that lists them.
const Statement kScheduleHealth{"schedule_health", R"(
    SELECT loops.*, months.ahead, rows_of_default.counted, oldest.months_ago,
           (SELECT kept.xmin::text FROM (
              SELECT unnest(ARRAY[backend_xmin, backend_xid]) AS xmin FROM pg_stat_activity
              WHERE pid <> pg_backend_pid() AND (datname = current_database() OR datname IS NULL)
              UNION ALL SELECT xmin FROM pg_replication_slots
              UNION ALL SELECT transaction FROM pg_prepared_xacts
              WHERE database = current_database()
            ) AS kept WHERE kept.xmin IS NOT NULL ORDER BY age(kept.xmin) DESC LIMIT 1) AS snapshot
    FROM (
      SELECT (SELECT count(*) FROM loopscope.loop WHERE enabled) AS enabled,
             count(*) AS overdue,
             coalesce(extract(epoch FROM now() - min(visible_at)), 0)::float8 AS lag_s,
             (SELECT count(*) FROM loopscope.schedule WHERE enabled AND attempts > 0) AS failing
      FROM (
        SELECT visible_at FROM loopscope.schedule
        WHERE enabled AND visible_at <= now()
          AND visible_at >= timestamptz 'epoch' + $2::bigint * interval '1 microsecond'
          AND (visible_at, loop_id)
            > (timestamptz 'epoch' + $2::bigint * interval '1 microsecond', $3::bigint)
        UNION ALL
        SELECT visible_at FROM loopscope.schedule
        WHERE enabled AND lost_leases >= 2 AND visible_at <= now() AND (visible_at, loop_id)
            <= (timestamptz 'epoch' + $2::bigint * interval '1 microsecond', $3::bigint)
      ) AS due
    ) AS loops
    CROSS JOIN (
      SELECT coalesce(min(month.number), 25) - 1 AS ahead
      FROM generate_series(0, 24) AS month (number)
      WHERE EXISTS (
        SELECT FROM pg_class AS parent
        WHERE parent.relnamespace = 'loopscope'::regnamespace AND parent.relkind = 'p'
          AND to_regclass(format('loopscope.%I', parent.relname || to_char(
                date_trunc('month', now() AT TIME ZONE 'UTC')
                + make_interval(months => month.number), '_YYYY_MM'))) IS NULL)
    ) AS months
    CROSS JOIN (
      SELECT count(*) AS counted FROM (
        SELECT 1 FROM loopscope.analysis_default
        UNION ALL SELECT 1 FROM loopscope.verdict_default
        UNION ALL SELECT 1 FROM loopscope.bicoherence_peak_default
        UNION ALL SELECT 1 FROM loopscope.explanation_step_default
        LIMIT $1::bigint) AS found
    ) AS rows_of_default
    CROSS JOIN (
      SELECT greatest(0, coalesce(max(12 * extract(year FROM age) + extract(month FROM age)), 0))
               ::integer AS months_ago
      FROM pg_class AS parent
      JOIN pg_inherits ON inhparent = parent.oid
      JOIN pg_class AS child ON child.oid = inhrelid
      CROSS JOIN LATERAL age(date_trunc('month', now() AT TIME ZONE 'UTC'),
                             to_timestamp(right(child.relname, 7), 'YYYY_MM')::timestamp) AS age
      WHERE parent.relnamespace = 'loopscope'::regnamespace AND parent.relkind = 'p'
        AND child.relname ~ '_[0-9]{4}_[0-9]{2}$'
    ) AS oldest)",
                                Rows::one, Kept::text};

}  // namespace

ScheduleHealth schedule_health(Session& session, DuePlace watermark) {
  const pqxx::result rows = session.transact([&](Transaction& transaction) {
    return transaction.run(kScheduleHealth,
                           {std::to_string(kMostDefaultRows), std::to_string(watermark.due_us),
                            std::to_string(watermark.loop_id)});
  });
  const pqxx::row row = rows[0];
  return {row["enabled"].as<std::int64_t>(),
          row["overdue"].as<std::int64_t>(),
          row["lag_s"].as<double>(),
          row["failing"].as<std::int64_t>(),
          row["ahead"].as<int>(),
          row["counted"].as<std::int64_t>(),
          row["months_ago"].as<int>(),
          row["snapshot"].is_null() ? "" : row["snapshot"].c_str()};
}

}  // namespace loopscope::storage
