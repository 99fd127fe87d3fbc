#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/loop_work.hpp"
#include "storage/results/leases/claim_watermark.hpp"
#include "storage/results/leases/schedule_health.hpp"
#include "storage/results/plant/plant_figures.hpp"
#include "storage/server_clock.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::storage {

/// The results schema `loopscope` as the worker sees it. One object = one connection; not shared
/// between threads. Every function is one or a few transactions, waits patience() at most for each
/// statement, and throws DatabaseError; after Remedy::reconnect the object must be thrown away.
/// Times are microseconds UTC since 1970, `owner` is host/pid, `lease_s` > 0 and at most 1 000 000.
class ResultsDatabase {
 public:
  /// Connects and checks that the schema has the version this program was built for. Whatever
  /// claims or writes, but for set_parameter(), asks `check` first and does nothing where that
  /// throws; an empty one lets everything pass.
  /// `watermarks` are shared by the connections of a process (claim_watermark.hpp).
  explicit ResultsDatabase(
      const ConnectionSettings& settings, ClockCheck check = {},
      std::shared_ptr<ClaimWatermarks> watermarks = std::make_shared<ClaimWatermarks>());
  ~ResultsDatabase();
  ResultsDatabase(ResultsDatabase&&) noexcept;
  ResultsDatabase& operator=(ResultsDatabase&&) noexcept;

  /// Claims up to `limit` enabled loops that are due, oldest first, for `lease_s` seconds; no
  /// suspects, and none of the sources `but_of`. What it costs does not depend on the age of
  /// anybody's snapshot. None are claimed only where none is due, as far as one look back shows.
  /// With more than one of `sharers` at most batch_share() of what is due.
  [[nodiscard]] std::vector<ClaimedLoop> claim_due(const std::string& owner, double lease_s,
                                                   int limit,
                                                   const std::vector<std::string>& but_of = {},
                                                   std::size_t sharers = 1);
  /// Claims one loop whose lease would have ended without a result three times in a row, if one is
  /// due: it may be what kills the workers. One that was held alone then is first given a pause of
  /// its own, a minute up to six hours.
  [[nodiscard]] std::vector<ClaimedLoop> claim_suspect(const std::string& owner, double lease_s);
  /// Claims up to `limit` enabled loops with loop_id > `after` that no living lease holds, due or
  /// not, in the order of loop_id: one pass over the catalogue, but for suspects.
  [[nodiscard]] std::vector<ClaimedLoop> claim_next(const std::string& owner, double lease_s,
                                                    int limit, std::int64_t after);
  /// Claims loops for slots of the past (loop_id, slot_end_us; of each loop one) without disturbing
  /// the work on their newest slots: the claim ends when the loop falls due, `lease_s` from now at
  /// the latest, and finish() leaves the schedule as it was. While any worker is at work,
  /// as seen within `lease_s`, only loops that nobody holds and that are not due for `reserve_s`
  /// (>= 0), or half of their period; else all but those of a living lease. No suspects. In the
  /// order of loop_id.
  [[nodiscard]] std::vector<ClaimedLoop> claim_past(
      const std::string& owner, double lease_s, double reserve_s,
      std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot);
  /// Digests of those (loop_id, slot_end_us) that are already stored under the revision, in any
  /// order; `settings_json`, a JSON object, is compared with the settings of each.
  [[nodiscard]] std::vector<StoredDigest> stored_digests(
      std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot, int algorithm_revision,
      const std::string& settings_json = "{}");
  /// Writes results and gives the loops back in ONE transaction; all were claimed for their newest
  /// slots, or all for slots of the past. A loop whose fence is no longer
  /// the claimed one, or whose slot is after now(), is skipped and counted. Repeating the call
  /// after a lost commit is harmless.
  WriteCount finish(std::span<const CompletedLoop> completed, std::span<const FailedLoop> failed);
  /// Gives claimed loops back untouched (shutdown): they are due at once.
  void release(std::span<const ClaimedLoop> claimed);
  /// Gives everything back untouched that this owner holds: what it claimed and never heard of.
  void release_owned(const std::string& owner);
  /// Undoes what a clock that was ahead has left behind: loops that are put off for longer than
  /// their period (or their pause after failures) are due now, claims end within the time for which
  /// they were made, and slots after now() make way for the newest stored one before. `settle_s`:
  /// what a loop may be put off beyond its period (schedule.settle_s). Returns of how many loops.
  std::size_t recall_stray(double settle_s);
  /// Lets these claims end `lease_s` seconds from now; returns those that are outdated because
  /// somebody has claimed the loop since. What is being given back in this moment is left alone.
  std::vector<ClaimKey> extend(std::span<const ClaimedLoop> claimed, double lease_s);
  /// Notes that the process is at work (table loopscope.worker).
  void see_worker(const WorkerSign& sign);
  /// Notes that the process (host/pid) ends.
  void leave_worker(const std::string& worker);
  /// Looks for loops that are due and that the next claims would pass over (claim_watermark.hpp),
  /// as every claim does that finds nothing; 30 ms of the server's time, a second at the first
  /// call.
  void look_back(const std::vector<std::string>& but_of = {});
  /// Seconds until the next enabled loop is due, or the lease of one that is held ends; negative =
  /// overdue; nullopt = there is none within `within_s` seconds.
  [[nodiscard]] std::optional<double> next_due_in_s(double within_s);

  /// The server's clock at the beginning of the transaction that asks for it.
  [[nodiscard]] ServerClock clock();
  /// What a person has said of clocks that differ (table loopscope.accepted_clock).
  [[nodiscard]] AcceptedClocks accepted_clocks();
  [[nodiscard]] std::size_t count_enabled_loops();
  /// Those of the loops that are still in the catalogue and enabled.
  [[nodiscard]] std::set<std::int64_t> enabled_of(std::span<const std::int64_t> loop_ids);
  /// How far the work as a whole is behind.
  [[nodiscard]] ScheduleHealth schedule_health();
  /// How the plant stands, in figures.
  [[nodiscard]] PlantFigures plant_figures();
  /// Stores the settings that the views compute with (table loopscope.parameter). Throws (give_up)
  /// for a name that the table does not have.
  void set_parameter(const std::string& name, double value);
  /// Adds to the bearer's cost of the running hour (table loopscope.stage_cost).
  void add_stage_cost(const CostBearer& bearer, const StageCost& cost);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
