#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/repair/judge_repair.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// A piece of work that is to be judged: for the first time, or again because the loop has a newer
/// slot, other work was entered for it, or min_confidence or the program has changed.
struct DueRepair {
  std::int64_t maintenance_event_id = 0;
  core::repair::RepairWindows windows;
  std::optional<std::int64_t> newest_slot_end_us;  ///< of the loop, when this was read
};

/// What is to be stored of it.
struct JudgedRepair {
  DueRepair repair;
  core::repair::RepairJudgement judgement;
};

/// The table repair_judgement, which the view before_after_maintenance shows. Work that was done
/// more than a year ago is judged once and no more: no window of it can be new. Every function is
/// one transaction and throws DatabaseError; two programs that judge the same work at once store
/// the same.
class RepairJudgements {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit RepairJudgements(const ConnectionSettings& settings);
  ~RepairJudgements();

  /// At most `limit` pieces of work, those that were entered first.
  [[nodiscard]] std::vector<DueRepair> due(std::size_t limit);
  /// An outcome stays when its windows have been deleted since (retention). Work that was deleted
  /// meanwhile is left out.
  void store(std::span<const JudgedRepair> judged);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
