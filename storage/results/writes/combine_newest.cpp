#include "storage/results/writes/combine_newest.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <pqxx/pqxx>

#include "core/signal/microseconds.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/writes/write_combined.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// Of each loop the combined slot before the wanted one, and whether any is behind it. The bounds
// that all share ($5, $6, $7) are constants, so that months outside are not even planned.
const Statement kCombinedBefore{"combined_before", R"(
    SELECT wanted.loop_id, before.end_s, before.probabilities, before.evidence, before.windows,
           later.is_there IS NOT NULL AS is_followed
    FROM unnest($1::bigint[], $2::integer[], $3::timestamptz[], $4::timestamptz[])
      AS wanted (loop_id, algorithm_revision, slot_end, earliest)
    LEFT JOIN LATERAL (
      SELECT extract(epoch FROM stored.window_end)::float8 AS end_s,
             stored.combined_probabilities::float8[] AS probabilities,
             stored.combined_evidence::float8[] AS evidence,
             stored.combined_windows::float8[] AS windows
      FROM loopscope.analysis AS stored
      WHERE stored.loop_id = wanted.loop_id
        AND stored.algorithm_revision = wanted.algorithm_revision
        AND stored.slot_end < wanted.slot_end AND stored.slot_end >= wanted.earliest
        AND stored.slot_end >= $5::timestamptz AND stored.slot_end < $7::timestamptz
        AND stored.combined_windows IS NOT NULL
      ORDER BY stored.slot_end DESC LIMIT 1) AS before ON true
    LEFT JOIN LATERAL (
      SELECT true AS is_there FROM loopscope.analysis AS stored
      WHERE stored.loop_id = wanted.loop_id
        AND stored.algorithm_revision = wanted.algorithm_revision
        AND stored.slot_end > wanted.slot_end AND stored.slot_end > $6::timestamptz
      LIMIT 1) AS later ON true)",
                                Rows::any, Kept::text};

/// The parameters of kCombinedBefore.
struct Wanted {
  ArrayLiteral loop_id, algorithm_revision, slot_end, earliest;
  std::int64_t earliest_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t first_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_us = std::numeric_limits<std::int64_t>::min();

  void add(const CompletedLoop& loop) {
    const ChangedSlots slots = changed_by(*loop.record);
    loop_id.add_integer(loop.loop_id);
    algorithm_revision.add_integer(loop.record->algorithm_revision);
    slot_end.add_time(slots.first_us);
    earliest.add_time(slots.earliest_us);
    earliest_us = std::min(earliest_us, slots.earliest_us);
    first_us = std::min(first_us, slots.first_us);
    last_us = std::max(last_us, slots.first_us);
  }
};

pqxx::result slots_beside(Transaction& transaction, const Wanted& wanted) {
  return transaction.run(
      kCombinedBefore,
      {wanted.loop_id.text(), wanted.algorithm_revision.text(), wanted.slot_end.text(),
       wanted.earliest.text(), timestamp_text(wanted.earliest_us), timestamp_text(wanted.first_us),
       timestamp_text(wanted.last_us)});
}

LoopWindows windows_before(const pqxx::row& row) {
  LoopWindows windows;
  if (!row["end_s"].is_null()) {
    windows.begin_with({{row["end_s"].as<double>(), read_number_list(row["evidence"]),
                         read_number_list(row["windows"])},
                        read_number_list(row["probabilities"])});
  }
  return windows;
}

double seconds(std::int64_t time_us) {
  return static_cast<double>(time_us) / core::signal::kMicrosecondsPerSecond;
}

/// The record as it will be stored.
Combined with_record(LoopWindows windows, const AnalysisRecord& record) {
  const core::diagnosis::Verdict& verdict = record.diagnosis.verdict;
  return windows.next(
      {seconds(record.window_start_us), seconds(record.window_end_us), !record.model_json.empty(),
       as_stored(core::diagnosis::evidence_of(verdict))},
      as_stored(core::diagnosis::probabilities_of(verdict)), verdict.priors);
}

}  // namespace

std::vector<std::optional<Combined>> combine_newest(
    Transaction& transaction, const std::vector<const CompletedLoop*>& loops) {
  std::map<std::int64_t, std::size_t> records_of;
  for (const CompletedLoop* loop : loops) ++records_of[loop->loop_id];
  Wanted wanted;
  for (const CompletedLoop* loop : loops)
    if (records_of[loop->loop_id] == 1) wanted.add(*loop);
  std::vector<std::optional<Combined>> combined(loops.size());
  if (wanted.first_us > wanted.last_us) return combined;
  std::map<std::int64_t, LoopWindows> newest;
  for (const pqxx::row& row : slots_beside(transaction, wanted)) {
    if (!row["is_followed"].as<bool>())
      newest[row["loop_id"].as<std::int64_t>()] = windows_before(row);
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (const auto found = newest.find(loops[i]->loop_id); found != newest.end())
      combined[i] = with_record(found->second, *loops[i]->record);
  }
  return combined;
}

}  // namespace loopscope::storage
