#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "storage/accepted_clocks.hpp"
#include "storage/analysis_record.hpp"
#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/data_problem.hpp"
#include "storage/error.hpp"
#include "storage/results/claim_floor.hpp"
#include "storage/results/schedule_health.hpp"
#include "storage/server_clock.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::storage {

/// What was said of a loop last.
struct LastVerdict {
  core::diagnosis::VerdictCode code = core::diagnosis::VerdictCode::healthy;
  double confidence = 0.0;
  std::optional<double> p;  ///< of the test behind it; nullopt = it rests on none
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
  std::int64_t slot_end_us = 0;
  std::int64_t next_due_us = 0;          ///< when it shall be looked at again
  std::optional<AnalysisRecord> record;  ///< nullopt = the stored analysis still holds
  /// The slot that was the newest one before this; nullopt = none, or this one was.
  std::optional<std::int64_t> previous_slot_end_us = std::nullopt;
  bool judged = true;  ///< false: the verdict is `insufficient_data` or `not_controlling`
  std::vector<DataProblem> problems = {};    ///< of the newest slot
  std::vector<AnalysisRecord> revised = {};  ///< of earlier slots whose input had changed since
};

/// A claimed loop whose work failed: it is set aside and retried after a pause.
struct FailedLoop {
  std::int64_t loop_id = 0;
  std::int64_t fence = 0;
  std::string error;
  double retry_after_s = 60.0;
  bool at_fault = true;  ///< false: its historian is away; counts as no failure of the loop
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
  std::size_t inserted = 0;         ///< new analysis rows
  std::size_t revised = 0;          ///< rows whose input had changed (input_revision raised)
  std::size_t unchanged = 0;        ///< completed without a new row
  std::size_t failed = 0;           ///< set aside
  std::size_t fenced_off = 0;       ///< the lease had been lost: nothing was written for these
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

/// The results schema `loopscope` as the worker sees it. One object = one connection; not shared
/// between threads. Every function throws DatabaseError; after Remedy::reconnect the object must
/// be thrown away.
class ResultsDatabase {
 public:
  /// Connects and checks that the schema has the version this program was built for. Whatever
  /// claims or writes asks `check` first and does nothing where that throws; an empty one lets
  /// everything pass.
  /// `floors` are shared by the connections of a process (claim_floor.hpp).
  explicit ResultsDatabase(const ConnectionSettings& settings, ClockCheck check = {},
                           std::shared_ptr<ClaimFloors> floors = std::make_shared<ClaimFloors>());
  ~ResultsDatabase();
  ResultsDatabase(ResultsDatabase&&) noexcept;
  ResultsDatabase& operator=(ResultsDatabase&&) noexcept;

  /// Claims up to `limit` enabled loops that are due, oldest first, for `lease_s` seconds; no
  /// suspects, and none of the sources `but_of`. What it costs does not depend on the age of
  /// anybody's snapshot. None are claimed only where none is due, as far as one look back shows.
  [[nodiscard]] std::vector<ClaimedLoop> claim_due(const std::string& owner, double lease_s,
                                                   int limit,
                                                   const std::vector<std::string>& but_of = {});
  /// Claims one loop whose lease would have ended without a result three times in a row, if one is
  /// due: it may be what kills the workers. One that was held alone then is first given a pause of
  /// its own, a minute up to six hours.
  [[nodiscard]] std::vector<ClaimedLoop> claim_suspect(const std::string& owner, double lease_s);
  /// Claims up to `limit` enabled loops with loop_id > `after` that no living lease holds, due or
  /// not, in the order of loop_id: one pass over the catalogue, but for suspects.
  [[nodiscard]] std::vector<ClaimedLoop> claim_next(const std::string& owner, double lease_s,
                                                    int limit, std::int64_t after);
  /// Digests of those (loop, slot, revision) that are already stored; `settings_json` is compared
  /// with the settings of each.
  [[nodiscard]] std::vector<StoredDigest> stored_digests(
      std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot, int algorithm_revision,
      const std::string& settings_json = "{}");
  /// Writes results and gives the loops back in ONE transaction. A loop whose fence is no longer
  /// the claimed one, or whose slot is after now(), is skipped and counted. Repeating the call
  /// after a lost commit is harmless.
  WriteCount finish(std::span<const CompletedLoop> completed, std::span<const FailedLoop> failed);
  /// Gives claimed loops back untouched (shutdown): they are due at once.
  void release(std::span<const ClaimedLoop> claimed);
  /// Gives everything back untouched that this owner holds: what it claimed and never heard of.
  void release_owned(const std::string& owner);
  /// Undoes what a clock that was ahead has left behind: loops that are put off for longer than
  /// their period (or their pause after failures) are due now, claims end within the time for which
  /// they were made, and slots after now() make way for the newest stored one before. Returns of
  /// how many loops.
  std::size_t recall_stray(double settle_s);
  /// Lets these claims end `lease_s` seconds from now; returns those that are outdated because
  /// somebody has claimed the loop since. What is being given back in this moment is left alone.
  std::vector<ClaimKey> extend(std::span<const ClaimedLoop> claimed, double lease_s);
  /// Notes that the process is at work (table loopscope.worker).
  void see_worker(const WorkerSign& sign);
  /// Looks for loops that are due and that the next claims would pass over (claim_floor.hpp), as
  /// every claim does that finds nothing.
  void look_back(const std::vector<std::string>& but_of = {});
  /// Seconds until the next enabled loop is due, or the lease of one that is held ends; negative =
  /// overdue; nullopt = there is none within `within_s` seconds.
  [[nodiscard]] std::optional<double> next_due_in_s(double within_s);

  [[nodiscard]] ServerClock clock();
  /// What a person has said of clocks that differ (table loopscope.accepted_clock).
  [[nodiscard]] AcceptedClocks accepted_clocks();
  [[nodiscard]] std::size_t count_enabled_loops();
  /// How far the work as a whole is behind.
  [[nodiscard]] ScheduleHealth schedule_health();
  /// Stores the settings that the views compute with (table loopscope.parameter).
  void set_parameter(const std::string& name, double value);
  /// Adds to the bearer's cost of the running hour (table loopscope.stage_cost).
  void add_stage_cost(const CostBearer& bearer, const StageCost& cost);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
