#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/fault_log.hpp"
#include "daemon/service/historian_pool.hpp"
#include "daemon/service/read_visits.hpp"
#include "daemon/service/slot.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// One worker: its own connection to the results, used by one thread at a time; those to the
/// historians are lent by a pool that all workers share. Claims loops, fetches their windows,
/// analyses them and writes the results back; a fault of one loop or one historian sets those loops
/// aside and stops nothing else. A dead connection is thrown away and made anew at the next use.
class Worker {
 public:
  Worker(std::shared_ptr<const config::Settings> settings, std::string owner, SlotRule slot_rule,
         FaultLog& faults, HistorianPool& historians);

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
  using Claims = std::vector<const storage::ClaimedLoop*>;
  struct Batch {
    std::vector<LoopVisit> visits;
    RowMemory rows;
    StoredAnalyses stored;
    std::vector<storage::CompletedLoop> completed;
    std::vector<storage::FailedLoop> failed;
  };

  storage::ResultsDatabase& results();
  [[nodiscard]] std::vector<std::pair<std::string, Claims>> by_source(
      const std::vector<storage::ClaimedLoop>& claims);
  storage::WriteCount process_source(const std::string& source, const Claims& claims);
  /// Runs `read` on a connection to the source; false when that failed and the loops were set
  /// aside.
  template <typename Read>
  bool with_source(const std::string& source, const Claims& claims, Batch& batch, Read read);
  bool read_newest(const std::string& source, const Claims& claims, Batch& batch);
  bool read_earlier(const std::string& source, const Claims& claims, Batch& batch);
  [[nodiscard]] StoredAnalyses stored_analyses(const std::vector<LoopVisit>& visits);
  void set_aside(const std::string& source, const Failure& failure, const Claims& claims,
                 Batch& batch);
  void analyse(Batch& batch);

  std::shared_ptr<const config::Settings> settings_;
  std::string settings_json_;  ///< provenance of every analysis
  std::string owner_;
  SlotRule slot_rule_;
  FaultLog& faults_;
  std::optional<Failure> first_failure_;
  HistorianPool& historians_;
  std::optional<storage::ResultsDatabase> results_;
};

}  // namespace loopscope::daemon
