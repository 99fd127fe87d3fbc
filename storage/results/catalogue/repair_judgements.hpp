#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/repair/judge_repair.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// A piece of work that is to be judged: for the first time, or again because the loop has a newer
/// slot, its work was entered, moved or deleted, or min_confidence or the program has changed.
struct DueRepair {
  std::int64_t maintenance_event_id = 0;
  core::repair::RepairWindows windows;
  std::optional<std::int64_t> newest_slot_end_us;  ///< of the loop, when this was read
  std::string works;  ///< digest of all work on the loop, when this was read
};

/// What is to be stored of it.
struct JudgedRepair {
  DueRepair repair;
  core::repair::RepairJudgement judgement;
};

/// The table repair_judgement, which the view before_after_maintenance shows. Where a loop's
/// last work is more than a year ago nothing is judged again for a newer slot: no window is new.
/// Every function is one transaction and throws DatabaseError; two programs that judge the same
/// work at once store the same. Not shared between threads.
class RepairJudgements {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit RepairJudgements(const ConnectionSettings& settings);
  ~RepairJudgements();

  /// At most `limit` pieces of work whose number is larger than `behind`, by number: who goes on
  /// behind the last one comes to an end, whatever happens meanwhile.
  [[nodiscard]] std::vector<DueRepair> due(std::size_t limit, std::int64_t behind = 0);
  /// Lets all work on these loops be judged again, however long ago it was: windows about it were
  /// added. Its outcomes stay until then.
  void make_due(std::span<const std::int64_t> loop_ids);
  /// An outcome stays when its windows have been deleted since (retention). Work that was deleted
  /// meanwhile is left out.
  void store(std::span<const JudgedRepair> judged);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
