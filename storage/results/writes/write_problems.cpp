#include "storage/results/writes/write_problems.hpp"

#include "storage/array_literal.hpp"

namespace loopscope::storage {
namespace {

// A problem that stood at the loop's slot before goes on; one that was away begins anew. One that
// was last seen after now(), under a clock ahead, goes on if it began before.
const Statement kNoteProblems{"note_problems", R"(
    INSERT INTO loopscope.standing_problem AS kept
      (loop_id, code, role, first_slot, last_slot, previous_slot, slots, last_row, figure)
    SELECT loop_id, code, role, slot, slot, previous_slot, 1, last_row, figure
    FROM unnest($1::bigint[], $2::text[], $3::text[], $4::timestamptz[], $5::timestamptz[],
                $6::timestamptz[], $7::float8[])
      AS found (loop_id, code, role, slot, previous_slot, last_row, figure)
    ON CONFLICT (loop_id, code, role) DO UPDATE SET
      first_slot = CASE WHEN kept.last_slot IN (EXCLUDED.last_slot, EXCLUDED.previous_slot)
                          OR kept.last_slot > now() AND kept.first_slot <= EXCLUDED.last_slot
                        THEN kept.first_slot ELSE EXCLUDED.first_slot END,
      slots = CASE WHEN kept.last_slot = EXCLUDED.last_slot THEN kept.slots
                   WHEN kept.last_slot = EXCLUDED.previous_slot THEN kept.slots + 1
                   WHEN kept.last_slot > now() AND kept.first_slot <= EXCLUDED.last_slot
                   THEN kept.slots ELSE 1 END,
      last_slot = EXCLUDED.last_slot, previous_slot = EXCLUDED.previous_slot,
      last_row = EXCLUDED.last_row, figure = EXCLUDED.figure
    WHERE kept.last_slot <= EXCLUDED.last_slot OR kept.last_slot > now())",
                              Rows::none, Kept::plan};

void add_time(ArrayLiteral& array, const std::optional<std::int64_t>& time_us) {
  time_us ? array.add_time(*time_us) : array.add_null();
}

}  // namespace

void write_problems(Transaction& transaction, const std::vector<const CompletedLoop*>& loops) {
  ArrayLiteral loop_id, code, role, slot, previous_slot, last_row, figure;
  bool any = false;
  for (const CompletedLoop* loop : loops) {
    for (const DataProblem& problem : loop->problems) {
      any = true;
      loop_id.add_integer(loop->loop_id);
      code.add_text(problem.code);
      role.add_text(problem.role);
      slot.add_time(loop->slot_end_us);
      add_time(previous_slot, loop->previous_slot_end_us);
      add_time(last_row, problem.last_row_us);
      figure.add_number(problem.figure);
    }
  }
  if (!any) return;
  transaction.run(kNoteProblems, {loop_id.text(), code.text(), role.text(), slot.text(),
                                  previous_slot.text(), last_row.text(), figure.text()});
}

}  // namespace loopscope::storage
