#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/results/results_database.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::storage {

/// What the lease protocol promises, in memory: one loop as the database has to show it.
struct LeaseModel {
  std::int64_t fence = 0;
  std::string owner;    ///< empty = nobody holds it
  bool visible = true;  ///< due, or its lease has ended
  int attempts = 0;
  int lost_leases = 0;
  std::optional<std::int64_t> last_slot_us;
  /// By slot end: the digest that is stored, and how many times it has changed.
  struct Row {
    std::string digest;
    int input_revision = 1;
    bool operator==(const Row&) const = default;
  };
  std::map<std::int64_t, Row> rows;

  /// Held by a worker whose lease has not ended.
  [[nodiscard]] bool is_held() const { return !owner.empty() && !visible; }
  /// Leases lost in a row, the one that has just ended included.
  [[nodiscard]] int lost() const { return lost_leases + (owner.empty() ? 0 : 1); }
  /// Loops that would lose their lease a third time are claimed alone.
  [[nodiscard]] bool is_suspect() const { return lost() >= 3; }

  /// What each operation makes of the loop. `fence` is the one that the worker claimed with: where
  /// it is no longer the loop's, nothing happens, and the call returns false.
  void claim(const std::string& worker);
  bool complete(const CompletedLoop& done, WriteCount& count);
  bool fail(std::int64_t claimed_with, WriteCount& count);
  void release(std::int64_t claimed_with);
  /// A suspect that was alone when its lease ended: out of reach for a while.
  void rest();
};

/// By loop_id.
using LeaseModels = std::map<std::int64_t, LeaseModel>;

/// The models as rows that the database has to show. Of the schedule: loop, fence, owner, whether
/// it is due or its lease has ended, failures and lost leases in a row, newest slot.
[[nodiscard]] tests::TextRows schedule_rows(const LeaseModels& loops);
/// Of the analyses: loop, slot, digest, how many times it was written, verdicts (one of each time),
/// and that its fence is not beyond the loop's.
[[nodiscard]] tests::TextRows analysis_rows(const LeaseModels& loops);

}  // namespace loopscope::storage
