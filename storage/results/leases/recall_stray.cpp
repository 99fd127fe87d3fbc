#include "storage/results/leases/recall_stray.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/rows/schedule_statements.hpp"

namespace loopscope::storage {

std::size_t recall_stray(Transaction& transaction, double settle_s) {
  const auto period_s = transaction.run(statements::kShortestPeriod)[0][0].as<double>();
  ArrayLiteral loop_id, fence, visible_at, slot_end;
  const pqxx::result strays =
      transaction.run(statements::kFindStray, {number_text(settle_s), number_text(period_s)});
  if (strays.empty()) return 0;
  for (const pqxx::row& stray : strays) {
    loop_id.add_integer(stray["loop_id"].as<std::int64_t>());
    fence.add_integer(stray["fence"].as<std::int64_t>());
    visible_at.add_time(stray["visible_at_us"].as<std::int64_t>());
    const auto slot_end_us = read_integer(stray["slot_end_us"]);
    slot_end_us ? slot_end.add_time(*slot_end_us) : slot_end.add_null();
  }
  const std::vector<std::string> columns{loop_id.text(), fence.text(), visible_at.text(),
                                         slot_end.text()};
  return static_cast<std::size_t>(transaction.run(statements::kRecall, columns).size());
}

}  // namespace loopscope::storage
