#pragma once

#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <vector>

#include "daemon/service/batches/kept_windows.hpp"
#include "daemon/service/batches/loop_task.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/text/failure.hpp"
#include "storage/error.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// Loops of one historian that a worker has claimed.
using Claims = std::vector<const storage::ClaimedLoop*>;

/// Claimed loops on their way through a worker: what was read, and what has come of it.
struct Batch {
  KeptWindows kept;
  std::vector<LoopTask> tasks = {};
  RowMemory rows = {};
  StoredAnalyses stored = {};
  std::vector<storage::CompletedLoop> completed = {};
  std::vector<storage::FailedLoop> failed = {};
  std::optional<Failure> first_failure =
      std::nullopt;  ///< why loops stand in `failed`, the first of the reasons
};

/// The loop cannot be brought to its end: it waits, longer each time.
void set_aside(const storage::ClaimedLoop& claim, const Failure& failure, Batch& batch);

[[nodiscard]] bool is_set_aside(std::int64_t loop_id, const Batch& batch);

/// Their source is away: the loops wait, without blame, but for those that were set aside before.
void postpone(const Claims& claims, const Failure& failure, double pause_s, Batch& batch);

/// Whether a database error comes from the rows of some loop (a value that cannot be read or
/// stored) and not from the database: then the others of the batch can do without it.
[[nodiscard]] inline bool is_row_error(const storage::DatabaseError& error) {
  // SQLSTATE classes: data exception, integrity constraint, program limit (a text too long).
  for (const char* row_class : {"22", "23", "54"}) {
    if (error.sqlstate().starts_with(row_class)) return true;
  }
  return false;
}

/// The error as a reason for setting loops aside.
[[nodiscard]] inline Failure as_failure(const storage::DatabaseError& error) {
  return {ExitCode::database, error.what(), error.hint()};
}

[[nodiscard]] inline Failure as_failure(const storage::ClaimedLoop& claim,
                                        const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return {ExitCode::fault, "loop \"" + claim.loop.name + "\": out of memory",
            "give the program more memory, fewer workers or a smaller window"};
  }
  return {ExitCode::fault, "loop \"" + claim.loop.name + "\": " + error.what(),
          "this is a fault in the program: please report it"};
}

}  // namespace loopscope::daemon
