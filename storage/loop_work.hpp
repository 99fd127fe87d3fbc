#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/signal/loop_window.hpp"
#include "storage/catalogue_entry.hpp"

// What a worker is given of a loop that it claims, and what it gives back. All times are
// microseconds UTC since 1970; a slot is named by its end.

namespace loopscope::storage {

/// Something about a loop's data that somebody should mend, as it stands at the newest slot.
struct DataProblem {
  std::string code;  ///< a flag of the analysis, or a code of loopscope.data_problem_kind
  std::string role;  ///< sp, pv, op, mv, mode; empty = as data_problem_kind says
  std::optional<std::int64_t> last_row_us;  ///< the tag's newest row, where that is what is wrong
  std::optional<double> figure;             ///< how much of it
};

/// One analysis as it is stored: keys, provenance and the diagnosis itself.
struct AnalysisRecord {
  std::int64_t slot_end_us = 0;  ///< microseconds UTC; the key together with loop and revision
  int algorithm_revision = core::kAlgorithmRevision;
  std::int64_t window_start_us = 0;                            ///< first sample of the window
  std::int64_t window_end_us = 0;                              ///< last sample of the window
  std::size_t samples = 0;                                     ///< grid slots in the window
  double sample_interval_s = 0.0;                              ///< 0 = unknown (no rows)
  std::optional<core::signal::PvPast> pv_past = std::nullopt;  ///< as known before the window
  std::string input_digest;  ///< 16 hexadecimal digits over all samples read, and settings
  std::string program_version;
  std::string settings_json;       ///< the analysis settings in force, as a JSON object
  double fetch_ms = 0.0;           ///< share of the batch's reading time
  double analyse_ms = 0.0;         ///< all of the analysis: the next three and the verdict
  double prepare_ms = 0.0;         ///< masks, gaps, archive, oscillation
  double statistics_ms = 0.0;      ///< higher-order statistics, shapes, performance
  std::optional<double> model_ms;  ///< the loop model; nullopt = none was fitted
  core::Diagnosis diagnosis;
  std::string hos_slow_json;  ///< the slow look as a JSON object; empty = there is none
  /// The loop model's story as the JSON object "model" of `analyze --json`; empty = there is none.
  /// Its steps become rows of explanation_step.
  std::string model_json;
};

/// What was said of a loop last.
struct LastVerdict {
  core::diagnosis::VerdictCode code = core::diagnosis::VerdictCode::healthy;
  double confidence = 0.0;  ///< 0 to 1
  std::optional<double> p;  ///< of the test behind it; nullopt = it rests on none
};

/// A slot of the past that a loop was claimed for (ResultsDatabase::claim_past()).
struct PastSlot {
  std::int64_t end_us = 0;
  std::int64_t due_us = 0;  ///< when the loop is due for its newest slot, as before this claim
};

/// A loop that this worker holds until its lease ends.
struct ClaimedLoop {
  CatalogueEntry loop;
  std::int64_t fence = 0;            ///< rises with every claim
  int attempts = 0;                  ///< failures in a row before this claim, lost leases included
  std::int64_t database_now_us = 0;  ///< the database's clock at the claim
  std::optional<std::int64_t> last_slot_end_us;            ///< newest slot that was completed
  std::optional<LastVerdict> last_verdict = std::nullopt;  ///< the newest one; nullopt = none yet
  /// What its windows so far tell of pv; nullopt = none yet, or by a program that did not say.
  std::optional<core::signal::PvPast> pv_past = std::nullopt;
  /// The slot that it was claimed for; the two members before are those of the slot before it.
  /// nullopt = its newest one.
  std::optional<PastSlot> past = std::nullopt;

  /// For CompletedLoop and FailedLoop.
  [[nodiscard]] std::optional<std::int64_t> kept_due_us() const {
    return past ? std::optional(past->due_us) : std::nullopt;
  }
};

/// Which claim of which loop.
struct ClaimKey {
  std::int64_t loop_id = 0;
  std::int64_t fence = 0;
  [[nodiscard]] auto operator<=>(const ClaimKey&) const = default;
};

/// A claimed loop that was brought to its end: give it back, with or without a new row.
struct CompletedLoop {
  std::int64_t loop_id = 0;
  std::int64_t fence = 0;
  std::int64_t slot_end_us = 0;          ///< not after the database's now()
  std::int64_t next_due_us = 0;          ///< when it shall be looked at again
  std::optional<AnalysisRecord> record;  ///< nullopt = the stored analysis still holds
  /// The slot that was the newest one before this; nullopt = none, or this one was.
  std::optional<std::int64_t> previous_slot_end_us = std::nullopt;
  bool judged = true;  ///< false: the verdict is `insufficient_data` or `not_controlling`
  std::vector<DataProblem> problems = {};    ///< of the newest slot
  std::vector<AnalysisRecord> revised = {};  ///< of earlier slots whose input had changed since
  /// Of a claim for a past slot: the loop is due then, and all else in its schedule and of the
  /// problems of its data stays as it was.
  std::optional<std::int64_t> kept_due_us = std::nullopt;
};

/// A claimed loop whose work failed: it is set aside and retried after a pause.
struct FailedLoop {
  std::int64_t loop_id = 0;
  std::int64_t fence = 0;
  std::string error;            ///< in words, shown as the loop's last error
  double retry_after_s = 60.0;  ///< from the database's now() on
  bool at_fault = true;         ///< false: its historian is away; counts as no failure of the loop
  /// As in CompletedLoop: no pause, no failure is noted.
  std::optional<std::int64_t> kept_due_us = std::nullopt;
};

/// What a process says of itself while it works.
struct WorkerSign {
  std::string worker;  ///< host/pid
  std::string program_version;
  int algorithm_revision = 0;
  std::size_t held_loops = 0;
  std::uint64_t lost_leases = 0;  ///< since its start
};

/// What a write did.
struct WriteCount {
  std::size_t inserted = 0;   ///< new analysis rows
  std::size_t revised = 0;    ///< rows whose input had changed (input_revision raised)
  std::size_t unchanged = 0;  ///< completed without a new row
  std::size_t failed = 0;     ///< set aside
  /// The lease had been lost, or the slot lies after now(): nothing was written for these.
  std::size_t fenced_off = 0;
  std::size_t not_judged = 0;       ///< of those completed: the newest slot is no loop in control
  std::size_t revised_earlier = 0;  ///< rows of earlier slots whose input had changed
};

/// The key of a stored analysis and its digest.
struct StoredDigest {
  std::int64_t loop_id = 0;
  std::int64_t slot_end_us = 0;
  std::string input_digest;
  bool usable = true;         ///< whether the loop could be judged
  bool same_settings = true;  ///< analysed with the settings that were asked with
  bool modelled = false;      ///< with a loop model
};

}  // namespace loopscope::storage
