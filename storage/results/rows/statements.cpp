#include "storage/results/rows/statements.hpp"

namespace loopscope::storage::statements {

const Statement kRefuseMaintenance{"refuse_maintenance", R"(
    SELECT place, CASE WHEN loop.loop_id IS NULL THEN 'unknown_loop'
                       WHEN entry.done_at > now() THEN 'in_future'
                       ELSE 'entered_already' END AS reason
    FROM (SELECT *, row_number() OVER (PARTITION BY loop_name, done_at, description ORDER BY place)
                      AS times
          FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[])
            WITH ORDINALITY AS given (loop_name, done_at, kind, description, place)) AS entry
    LEFT JOIN loopscope.loop ON loop.name = entry.loop_name
    WHERE loop.loop_id IS NULL OR entry.done_at > now() OR times > 1
       OR EXISTS (SELECT FROM loopscope.maintenance_event AS known
                  WHERE known.loop_id = loop.loop_id AND known.done_at = entry.done_at
                    AND known.description = entry.description)
    ORDER BY place)"};

const Statement kAddMaintenance{"add_maintenance", R"(
    INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)
    SELECT loop.loop_id, entry.done_at, entry.kind, entry.description
    FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[])
      AS entry (loop_name, done_at, kind, description)
    JOIN loopscope.loop ON loop.name = entry.loop_name)",
                                Rows::none};

const Statement kListMaintenance{"list_maintenance", R"(
    SELECT maintenance_event_id, loop_name, (extract(epoch FROM done_at) * 1000000)::bigint
             AS done_at_us, kind, description, word, statement
    FROM loopscope.before_after_maintenance
    WHERE NOT $1::boolean OR loop_id IN (SELECT loop_id FROM loopscope.loop
                                         WHERE name = ANY ($2::text[]))
    ORDER BY loop_name, done_at, maintenance_event_id)"};

}  // namespace loopscope::storage::statements
