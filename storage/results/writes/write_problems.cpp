#include "storage/results/writes/write_problems.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/rows/statements.hpp"

namespace loopscope::storage {
namespace {

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
  transaction.run(statements::kNoteProblems,
                  {loop_id.text(), code.text(), role.text(), slot.text(), previous_slot.text(),
                   last_row.text(), figure.text()});
}

}  // namespace loopscope::storage
