#include "storage/results/reports/plant_report_statements.hpp"

namespace loopscope::storage::statements {

const Statement kPlantMembers{"plant_members", R"(
    SELECT event.number, event.period_s, event.source_loop_name, event.statement, event.p,
           event.outside, (extract(epoch FROM event.slot_end) * 1000000)::bigint AS slot_end_us,
           member.loop_id, member.loop_name, member.role, member.strength, member.lag_s,
           member.score, member.reasons
    FROM loopscope.current_plant_oscillation AS event
    JOIN loopscope.plant_oscillation_member AS member USING (slot_end, algorithm_revision, number)
    ORDER BY event.number, member.role = 'source' DESC, member.strength DESC, member.loop_name)"};

const Statement kPlantLeads{"plant_leads", R"(
    SELECT event.number, lead.*
    FROM loopscope.current_plant_oscillation AS event
    CROSS JOIN LATERAL jsonb_to_recordset(event.leads)
      AS lead (from_loop_id bigint, to_loop_id bigint, gain float8, direct float8)
    WHERE num_nulls(lead.from_loop_id, lead.to_loop_id, lead.gain) = 0
    ORDER BY event.number, lead.gain DESC)"};

// Read of the newest round alone: a trace of each event is kept, and each takes some kilobytes.
const Statement kPlantTraces{"plant_traces", R"(
    SELECT event.number, trace.*
    FROM loopscope.newest_plant_round AS round
    JOIN loopscope.plant_oscillation AS event USING (slot_end, algorithm_revision)
    CROSS JOIN LATERAL ROWS FROM (jsonb_to_recordset(event.traces)
      AS (loop_id bigint, start_us bigint, step_s float8, error float8[], periods_s float8[],
          power float8[])) WITH ORDINALITY
      AS trace (loop_id, start_us, step_s, error, periods_s, power, place)
    WHERE event.number <= round.events
      AND num_nulls(trace.loop_id, trace.start_us, trace.step_s) = 0
    ORDER BY event.number, trace.place)"};

const Statement kFollowed{"followed", R"(
    SELECT followed.number, followed.period_s, followed.source_loop_name, followed.role,
           followed.strength, latest.shown_code
    FROM loopscope.following_loop AS followed
    JOIN loopscope.own_verdict AS latest USING (loop_id)
    WHERE loop_id = $1::bigint AND latest.follows_oscillation IS NOT NULL)"};

}  // namespace loopscope::storage::statements
