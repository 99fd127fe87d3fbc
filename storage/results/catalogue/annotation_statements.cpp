#include "storage/results/catalogue/annotation_statements.hpp"

namespace loopscope::storage::statements {

const Statement kListAnnotations{"list_annotations", R"(
    SELECT loop_name, kind, code, (extract(epoch FROM until) * 1000000)::bigint AS until_us,
           reason, author, (extract(epoch FROM entered_at) * 1000000)::bigint AS entered_at_us
    FROM loopscope.annotation_in_force
    ORDER BY loop_name, entered_at)"};

// Only withdrawn_at is written: an engineer may change nothing else of what was said. It is asked
// for again, since another may have taken it back while this one waited for the row.
const Statement kReplaceAnnotations{"replace_annotations", R"(
    UPDATE loopscope.annotation AS said SET withdrawn_at = now()
    FROM loopscope.annotation_in_force AS holds
    WHERE holds.annotation_id = said.annotation_id AND said.withdrawn_at IS NULL
      AND holds.loop_name = $1 AND holds.kind = $2
      AND holds.code IS NOT DISTINCT FROM nullif($3, '')
    RETURNING said.annotation_id)"};

const Statement kAddAnnotation{"add_annotation", R"(
    INSERT INTO loopscope.annotation (loop_id, kind, code, until, reason)
    SELECT loop_id, $2, nullif($3, ''), nullif($4, '')::timestamptz, nullif($5, '')
    FROM loopscope.loop WHERE name = $1
    RETURNING annotation_id)"};

const Statement kWithdrawAnnotations{"withdraw_annotations", R"(
    UPDATE loopscope.annotation AS said SET withdrawn_at = now()
    FROM loopscope.annotation_in_force AS holds
    WHERE holds.annotation_id = said.annotation_id AND said.withdrawn_at IS NULL
      AND holds.loop_name = $1 AND ($2 = '' OR holds.code = $2)
    RETURNING said.annotation_id)"};

const Statement kNewestCode{"newest_code",
                            "SELECT code FROM loopscope.own_verdict WHERE loop_name = $1"};

const Statement kFaultCodes{"fault_codes",
                            "SELECT code FROM loopscope.verdict_kind WHERE is_fault ORDER BY code"};

}  // namespace loopscope::storage::statements
