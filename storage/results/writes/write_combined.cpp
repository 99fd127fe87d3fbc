#include "storage/results/writes/write_combined.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <pqxx/pqxx>
#include <string>
#include <tuple>
#include <utility>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/signal/grid.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/writes/loop_windows.hpp"
#include "storage/statement.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

namespace diagnosis = core::diagnosis;
using diagnosis::PerCause;

// Of each loop the slots from the first changed one on, and the combined one before them. The bound
// that all share is a constant, so that months before it are not even planned.
const Statement kWindowsToCombine{"windows_to_combine", R"(
    SELECT wanted.loop_id, (extract(epoch FROM slot.slot_end) * 1000000)::bigint AS slot_end_us,
           extract(epoch FROM slot.window_start)::float8 AS start_s,
           extract(epoch FROM slot.window_end)::float8 AS end_s,
           slot.model IS NOT NULL AS with_model, slot.is_before,
           slot.combined_windows::float8[]::text AS windows,
           CASE WHEN slot.is_before THEN slot.combined_probabilities
                ELSE given.cause_probabilities END::float8[]::text AS probabilities,
           CASE WHEN slot.is_before THEN slot.combined_evidence
                ELSE given.cause_evidence END::float8[]::text AS evidence
    FROM unnest($1::bigint[], $3::timestamptz[], $4::timestamptz[])
      AS wanted (loop_id, first, earliest)
    CROSS JOIN LATERAL (
      (SELECT stored.*, true AS is_before FROM loopscope.analysis AS stored
       WHERE stored.loop_id = wanted.loop_id AND stored.algorithm_revision = $2::integer
         AND stored.slot_end < wanted.first AND stored.slot_end >= wanted.earliest
         AND stored.slot_end >= $5::timestamptz AND stored.combined_windows IS NOT NULL
       ORDER BY stored.slot_end DESC LIMIT 1)
      UNION ALL
      (SELECT stored.*, false FROM loopscope.analysis AS stored
       WHERE stored.loop_id = wanted.loop_id AND stored.algorithm_revision = $2::integer
         AND stored.slot_end >= wanted.first AND stored.slot_end >= $5::timestamptz)) AS slot
    LEFT JOIN LATERAL (
      SELECT said.cause_evidence, said.cause_probabilities FROM loopscope.verdict AS said
      WHERE said.loop_id = slot.loop_id AND said.slot_end = slot.slot_end
        AND said.algorithm_revision = slot.algorithm_revision
        AND said.input_revision = slot.input_revision AND said.slot_end >= $5::timestamptz
      LIMIT 1) AS given ON true
    ORDER BY wanted.loop_id, slot.slot_end)"};

const Statement kSetCombined{"set_combined", R"(
    UPDATE loopscope.analysis AS stored
    SET combined_probabilities = row.probabilities::real[],
        combined_evidence = row.evidence::real[], combined_windows = row.windows::real[]
    FROM unnest($1::bigint[], $2::timestamptz[], $4::text[], $5::text[], $6::text[])
      AS row (loop_id, slot_end, probabilities, evidence, windows)
    WHERE stored.loop_id = row.loop_id AND stored.slot_end = row.slot_end
      AND stored.algorithm_revision = $3::integer AND stored.slot_end >= $7::timestamptz
      AND (stored.combined_evidence, stored.combined_windows, stored.combined_probabilities)
          IS DISTINCT FROM
          (row.evidence::real[], row.windows::real[], row.probabilities::real[]))",
                             Rows::none};

/// Rows of analysis to write, an array for each column.
struct CombinedRows {
  ArrayLiteral loop_id, slot_end, probabilities, evidence, windows;
  std::int64_t first_us = std::numeric_limits<std::int64_t>::max();

  void add(const pqxx::row& row, const Combined& combined) {
    const auto slot_end_us = row["slot_end_us"].as<std::int64_t>();
    first_us = std::min(first_us, slot_end_us);
    loop_id.add_integer(row["loop_id"].as<std::int64_t>());
    slot_end.add_time(slot_end_us);
    probabilities.add_real_list(combined.probabilities);
    evidence.add_real_list(combined.odds.evidence);
    windows.add_real_list(combined.odds.windows);
  }
};

Combined stored_combination(const pqxx::row& row) {
  return {{row["end_s"].as<double>(), read_number_list(row["evidence"]),
           read_number_list(row["windows"])},
          read_number_list(row["probabilities"])};
}

diagnosis::JudgedWindow stored_window(const pqxx::row& row) {
  return {row["start_s"].as<double>(), row["end_s"].as<double>(), row["with_model"].as<bool>(),
          read_number_list(row["evidence"])};
}

pqxx::result windows_of(Transaction& transaction, int algorithm_revision,
                        const std::map<std::int64_t, ChangedSlots>& changed) {
  ArrayLiteral loop_id, first, earliest;
  std::int64_t earliest_us = std::numeric_limits<std::int64_t>::max();
  for (const auto& [id, slots] : changed) {
    loop_id.add_integer(id);
    first.add_time(slots.first_us);
    earliest.add_time(slots.earliest_us);
    earliest_us = std::min(earliest_us, slots.earliest_us);
  }
  return transaction.run(kWindowsToCombine,
                         {loop_id.text(), std::to_string(algorithm_revision), first.text(),
                          earliest.text(), timestamp_text(earliest_us)});
}

}  // namespace

ChangedSlots changed_by(const AnalysisRecord& record) {
  constexpr std::int64_t kLeast_us = 86'400'000'000;
  const auto window_us =
      static_cast<double>(std::max(kLeast_us, record.window_end_us - record.window_start_us));
  return {
      record.slot_end_us,
      core::signal::moved_us(record.slot_end_us, -diagnosis::longest_memory_windows() * window_us)};
}

void write_combined(Transaction& transaction, int algorithm_revision,
                    const std::map<std::int64_t, ChangedSlots>& changed, const PerCause& priors) {
  if (changed.empty()) return;
  CombinedRows rows;
  std::map<std::int64_t, LoopWindows> loops;
  for (const pqxx::row& row : windows_of(transaction, algorithm_revision, changed)) {
    LoopWindows& loop = loops[row["loop_id"].as<std::int64_t>()];
    if (row["is_before"].as<bool>())
      loop.begin_with(stored_combination(row));
    else
      rows.add(row, loop.next(stored_window(row), read_number_list(row["probabilities"]), priors));
  }
  if (loops.empty()) return;
  transaction.run(kSetCombined,
                  {rows.loop_id.text(), rows.slot_end.text(), std::to_string(algorithm_revision),
                   rows.probabilities.text(), rows.evidence.text(), rows.windows.text(),
                   timestamp_text(rows.first_us)});
}

}  // namespace loopscope::storage
