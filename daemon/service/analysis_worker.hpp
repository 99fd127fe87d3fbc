#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/batches/batch_reader.hpp"
#include "daemon/service/observe/stage_driver.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "daemon/service/windows/slot.hpp"
#include "daemon/text/failure.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// A worker: claims a batch of loops, fetches their windows, analyses them and writes the
/// results back, then the next batch. There are more workers than cores, so that some fetch and
/// write while others analyse; as many as there are cores analyse at a time (CoreGate), and memory
/// holds one batch a worker, whatever the number of loops.
///
/// Each has its own connection to the results, used by one thread at a time; those to the
/// historians are lent by a pool. A fault of one loop or one historian sets those loops aside and
/// stops nothing else; work that is done is kept until the results database takes it.
class AnalysisWorker {
 public:
  /// `index` tells the workers of a process apart.
  AnalysisWorker(std::shared_ptr<const config::Settings> settings, std::size_t index,
                 SlotRule slot_rule, SharedServices& tools);
  AnalysisWorker(const AnalysisWorker&) = delete;  // its parts refer to each other
  AnalysisWorker& operator=(const AnalysisWorker&) = delete;

  /// Claims a share of the loops that are due; none where this worker rests while all loops are
  /// compared. Throws storage::DatabaseError when the results database fails.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_due();
  /// Claims one loop that may be what kills processes, if no other worker has one in hand.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_suspect();
  /// Claims the next loops after `after` in the order of the catalogue, a share of the `left` that
  /// are left of it; no suspects.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_next(std::int64_t after, std::size_t left);
  /// Claims loops for slots of the past (loop_id, slot_end_us), those that are not due for
  /// `reserve_s`; a results database that is away is tried again for a while.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_past(
      double reserve_s, std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot);
  /// Brings claimed loops to their end. Throws storage::DatabaseError when the results cannot be
  /// written; the loops are then given back or, where that fails too, their claims run out.
  storage::WriteCount process(const std::vector<storage::ClaimedLoop>& claims);
  /// Seconds until a loop is due; nullopt = not before the next poll.
  [[nodiscard]] std::optional<double> next_due_in_s();

  [[nodiscard]] const std::shared_ptr<const config::Settings>& settings() const {
    return settings_;
  }
  /// Where the time went since this worker was made.
  [[nodiscard]] const storage::StageCost& cost() const { return costs_.sum(); }
  /// Logs that the results database failed this worker, until it works for it.
  void say(const storage::DatabaseError& error) { results_.say(error); }
  /// Stores what of that is not stored yet; a database that fails is a fault for the log.
  void store_cost();
  /// Why loops were set aside, the first time that any was; nullopt = none was.
  [[nodiscard]] const std::optional<Failure>& first_failure() const { return first_failure_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::vector<std::pair<std::string, Claims>> by_source(
      const std::vector<storage::ClaimedLoop>& claims);
  /// `again`: a results database that is away is tried again.
  template <typename Claim>
  std::vector<storage::ClaimedLoop> timed_claim(Claim claim, bool again = false);
  template <typename Use>
  auto with_retry(Use use) {
    return results_.with_retry(tools_.perseverance, use, [this] { progress_.step(); });
  }
  storage::WriteCount process_source(const std::string& source, const Claims& claims);
  [[nodiscard]] std::size_t enabled_loops();
  /// Returns how many were left out because others have claimed them since.
  std::size_t analyse(Batch& batch);
  void complete(LoopTask& task, const AnalysisOrders& orders, Batch& batch);
  storage::WriteCount write(const Claims& claims, Batch& batch);
  storage::WriteCount write_one_by_one(const Claims& claims, Batch& batch);
  storage::WriteCount finish(const std::vector<storage::CompletedLoop>& completed,
                             const std::vector<storage::FailedLoop>& failed);
  void give_back(const std::string& reason);
  /// Adds to what this worker and the process have taken so far.
  void account(const storage::StageCost& cost);
  void store_cost(const std::optional<storage::StageCost>& cost);

  std::shared_ptr<const config::Settings> settings_;
  std::string settings_json_;  ///< provenance of every analysis
  std::size_t index_;
  std::string owner_;
  SharedServices& tools_;
  ProgressBoard::Entry& progress_;
  StageDriver driver_;
  ResultsLink results_;
  BatchReader reader_;
  bool in_doubt_ = false;  ///< the worker may hold loops that it does not know of
  std::unique_lock<std::mutex> suspect_turn_;
  std::optional<Failure> first_failure_;
  StageTimings costs_;
  std::size_t enabled_loops_ = 0;
  std::optional<Clock::time_point> counted_at_;
};

}  // namespace loopscope::daemon
