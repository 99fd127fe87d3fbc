#pragma once

#include <pqxx/pqxx>
#include <string>
#include <vector>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::storage {

/// Rows of the statements of report_statements.hpp as values. A value of another type than the
/// statement's throws pqxx::conversion_error.
/// But for what is counted of the two lists (count_lists).
[[nodiscard]] PlantCounts read_counts(const pqxx::row& row);
[[nodiscard]] UnjudgedReason read_reason(const pqxx::row& row);
[[nodiscard]] NotControllingRow read_not_controlling(const pqxx::row& row);
[[nodiscard]] FlaggedRow read_flagged(const pqxx::row& row);
[[nodiscard]] HistoryPoint read_history_point(const pqxx::row& row);
[[nodiscard]] HiddenLoopRow read_hidden_loop(const pqxx::row& row);
[[nodiscard]] DataProblemRow read_problem(const pqxx::row& row);

/// Figure by figure into repairs; the rows of one repair stand together.
[[nodiscard]] std::vector<RepairRow> read_repairs(const pqxx::result& rows);

}  // namespace loopscope::storage
