#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/cost_book.hpp"
#include "daemon/service/lane_tools.hpp"
#include "daemon/service/read_visits.hpp"
#include "daemon/service/slot.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// One lane of work: claims a batch of loops, fetches their windows, analyses them and writes the
/// results back, then the next batch. There are more lanes than cores, so that some fetch and write
/// while others analyse; as many as there are cores analyse at a time (CoreGate), and memory holds
/// one batch a lane, whatever the number of loops.
///
/// Each has its own connection to the results, used by one thread at a time; those to the
/// historians are lent by a pool. A fault of one loop or one historian sets those loops aside and
/// stops nothing else. A dead connection is thrown away and made anew at the next use.
class Lane {
 public:
  /// `index` tells the lanes of a process apart.
  Lane(std::shared_ptr<const config::Settings> settings, std::size_t index, SlotRule slot_rule,
       LaneTools& tools);

  /// Claims loops that are due. Throws storage::DatabaseError when the results database fails.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_due();
  /// Claims the next loops after `after` in the order of the catalogue.
  [[nodiscard]] std::vector<storage::ClaimedLoop> claim_next(std::int64_t after);
  /// Brings claimed loops to their end. Throws storage::DatabaseError when the results cannot be
  /// written; the leases then run out and another worker takes over.
  storage::WriteCount process(const std::vector<storage::ClaimedLoop>& claims);

  [[nodiscard]] const std::shared_ptr<const config::Settings>& settings() const {
    return settings_;
  }
  /// Where the time went since this lane was made.
  [[nodiscard]] const storage::StageCost& cost() const { return costs_.sum(); }
  /// Stores what of that is not stored yet; a database that fails is a fault for the log.
  void store_cost();
  /// Why loops were set aside, the first time that any was; nullopt = none was.
  [[nodiscard]] const std::optional<Failure>& first_failure() const { return first_failure_; }
  /// Calls `use(storage::ResultsDatabase&)`, connecting when there is no connection; a dead one is
  /// forgotten before its error goes on.
  template <typename Use>
  auto with_results(Use use) {
    try {
      return use(results());
    } catch (const storage::DatabaseError& error) {
      if (error.remedy() == storage::Remedy::reconnect) results_.reset();
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Claims = std::vector<const storage::ClaimedLoop*>;
  struct Batch {
    std::vector<LoopVisit> visits;
    RowMemory rows;
    StoredAnalyses stored;
    std::vector<storage::CompletedLoop> completed;
    std::vector<storage::FailedLoop> failed;
    storage::StageCost cost = {};
  };

  storage::ResultsDatabase& results();
  [[nodiscard]] std::vector<std::pair<std::string, Claims>> by_source(
      const std::vector<storage::ClaimedLoop>& claims);
  template <typename Claim>
  std::vector<storage::ClaimedLoop> timed_claim(Claim claim);
  storage::WriteCount process_source(const std::string& source, const Claims& claims);
  /// Reads all that the batch needs; false when that failed and the loops were set aside.
  bool fetch(const std::string& source, const Claims& claims, Batch& batch);
  /// Runs `read` on a connection to the source; false when that failed and the loops were set
  /// aside.
  template <typename Read>
  bool with_source(const std::string& source, const Claims& claims, Batch& batch, Read read);
  bool read_newest(const std::string& source, const Claims& claims, Batch& batch);
  bool read_earlier(const std::string& source, const Claims& claims, Batch& batch);
  [[nodiscard]] std::size_t enabled_loops();
  [[nodiscard]] StoredAnalyses stored_analyses(const std::vector<LoopVisit>& visits);
  void set_aside(const std::string& source, const Failure& failure, const Claims& claims,
                 Batch& batch);
  void analyse(Batch& batch);
  void complete(const LoopVisit& visit, const AnalysisOrders& orders, Batch& batch);
  storage::WriteCount write(Batch& batch);
  void store_cost(const std::optional<storage::StageCost>& cost);

  std::shared_ptr<const config::Settings> settings_;
  std::string settings_json_;  ///< provenance of every analysis
  std::size_t index_;
  std::string owner_;
  SlotRule slot_rule_;
  LaneTools& tools_;
  std::optional<Failure> first_failure_;
  std::optional<storage::ResultsDatabase> results_;
  CostBook costs_;
  std::size_t enabled_loops_ = 0;
  std::optional<Clock::time_point> counted_at_;
};

}  // namespace loopscope::daemon
