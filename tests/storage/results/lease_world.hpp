#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/storage/results/lease_model.hpp"
#include "tests/storage/results/lease_steps.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::storage {

/// A process: its connection, what it believes to hold, what it wrote last.
struct LeaseWorker {
  std::string name;
  ResultsDatabase results;
  std::vector<ClaimedLoop> believes;
  std::vector<CompletedLoop> last_completed;
  std::vector<FailedLoop> last_failed;
};

/// Workers on a real database beside the model of what it has to show. Every member function
/// asserts (RC_ASSERT) that what the database answers is what the model says.
class LeaseWorld {
 public:
  /// The database has the schema and some loops.
  explicit LeaseWorld(const tests::TestDatabase& database);

  /// Everything as it was before the first claim.
  void begin();

  void take(const Step& step);

  /// The database shows what the model says, and what holds of every history.
  void check();

 private:
  /// One row per analysis: after deeds that may write, since to ask costs more than a deed.
  void check_analyses();
  /// At most one worker's claim carries the fence that writes.
  void check_holders();
  void take_claims(LeaseWorker& worker, const std::vector<ClaimedLoop>& claimed,
                   const std::vector<std::int64_t>& expected);
  void claim(LeaseWorker& worker);
  void claim_next(LeaseWorker& worker, std::size_t which);
  void claim_suspect(LeaseWorker& worker);
  void complete(LeaseWorker& worker, std::size_t which, bool with_row);
  void fail(LeaseWorker& worker, std::size_t which);
  void finish(LeaseWorker& worker);
  void release(LeaseWorker& worker, std::size_t which);
  void extend(LeaseWorker& worker);
  /// The time of a lease, or until a loop is due, passes.
  void end_wait(std::size_t which, bool is_lease);
  [[nodiscard]] std::int64_t id_of(std::size_t which) const;
  /// What the worker lets go of with the operation that follows.
  static ClaimedLoop drop(LeaseWorker& worker, std::size_t which);

  const tests::TestDatabase& database_;
  std::vector<LeaseWorker> workers_;
  LeaseModels loops_;
  int number_ = 0;
  bool written_ = false;
};

}  // namespace loopscope::storage
