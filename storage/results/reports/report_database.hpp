#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/results/reports/listed_loops.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::storage {

/// One moment of the results for a reader: a read-only transaction at REPEATABLE READ that begins
/// with the object and ends with it, so that the parts of a report agree with each other whatever
/// the workers write meanwhile. One object = one connection; not shared between threads. Hold it
/// for as long as the reading takes and no longer: while it lives, vacuum keeps old rows, and the
/// server ends it after `settings.idle_timeout_s` without a question. Times are microseconds UTC
/// since 1970. Every function throws DatabaseError; after Remedy::reconnect the object must be
/// thrown away.
class ReportDatabase {
 public:
  /// Connects, checks that the schema has the version this program was built for and takes the
  /// snapshot. The rights of a reader are enough.
  explicit ReportDatabase(const ConnectionSettings& settings);
  ~ReportDatabase();
  ReportDatabase(ReportDatabase&&) noexcept;
  ReportDatabase& operator=(ReportDatabase&&) noexcept;

  /// The database's clock at the beginning of the view.
  [[nodiscard]] std::int64_t now_us();
  /// `since_us`: what began after this time counts as new, what was repaired after it as fixed.
  [[nodiscard]] PlantCounts counts(std::int64_t since_us);
  /// The work list, in the order of its ranks.
  [[nodiscard]] std::vector<FlaggedRow> flagged();
  /// The slots of a loop from `from_us` on, oldest first; empty for an unknown one, here and below.
  [[nodiscard]] std::vector<HistoryPoint> history(std::int64_t loop_id, std::int64_t from_us);
  /// Work done at or after `since_us`, newest first.
  [[nodiscard]] std::vector<RepairRow> repairs(std::int64_t since_us);
  /// The same of one loop, whenever it was done.
  [[nodiscard]] std::vector<RepairRow> repairs_of(std::int64_t loop_id);
  /// Of the newest plant round; empty = none is shared, or no round was made yet.
  [[nodiscard]] std::vector<PlantOscillationRow> plant_oscillations();
  /// The shared oscillation that a loop follows; nullopt = none, or it is its source.
  [[nodiscard]] std::optional<FollowedRow> followed_by(std::int64_t loop_id);
  /// Findings that are kept off the list, by loop.
  [[nodiscard]] std::vector<HiddenLoopRow> hidden();
  /// What is wrong with the newest data of a loop.
  [[nodiscard]] std::vector<DataProblemRow> data_problems(std::int64_t loop_id);
  /// The newest verdict of any loop, flagged (with its rank) or not (rank 0); nullopt = there is
  /// no such loop, or it was never analysed.
  [[nodiscard]] std::optional<FlaggedRow> latest(const std::string& loop_name);
  /// The newest verdict of a loop as if it were not on the list: rank 0. Does not read the list.
  [[nodiscard]] std::optional<FlaggedRow> newest(const std::string& loop_name);
  /// Every loop of the catalogue, by rank and name.
  [[nodiscard]] ListedLoops loops();
  /// `text` in small letters as the database has them (LoopRow::searched); empty where no text of
  /// the database can hold it.
  [[nodiscard]] std::string in_small_letters(const std::string& text);

  /// What other thresholds would flag: the rows in their would-be order, then those that would be
  /// lost. nullopt = the present setting. `false_discovery_rate` 0 to 1, `dependence` 0 or 1
  /// (parameter false_discovery_dependence), `min_confidence` 0 to 1.
  /// daemon/output/what_if_text makes a table of it.
  [[nodiscard]] std::vector<WhatIfRow> what_if(std::optional<double> false_discovery_rate,
                                               std::optional<int> dependence,
                                               std::optional<double> min_confidence);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
