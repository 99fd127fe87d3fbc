#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// Where the workers show that they get on, and what they hold: the heartbeat extends the leases of
/// those that do, the watchdog and /livez look for those that do not. A step is shown after each
/// thing that may take long (a statement, an analysis), so a worker that hangs shows none, however
/// well its process is otherwise. Who waits for a core gets on as long as anybody who works does.
/// Thread-safe.
class ProgressBoard {
 public:
  using Clock = std::chrono::steady_clock;

  /// One worker's place. Lives as long as the board.
  class Entry {
   public:
    /// The worker has claimed these loops.
    void hold(const std::vector<storage::ClaimedLoop>& claims);
    /// All are given back.
    void drop();
    /// These are given back, the work on the others goes on.
    void done(std::span<const std::int64_t> loop_ids);
    /// What is held and, as far as is known, not lost.
    [[nodiscard]] std::vector<storage::ClaimedLoop> held();
    /// The worker got on.
    void step();
    /// The claim is outdated, others have the loop: work on it would be refused.
    [[nodiscard]] bool lost(std::int64_t loop_id);

    /// The worker waits for its turn as long as this lives.
    class Wait {
     public:
      explicit Wait(Entry& progress) : progress_(progress) { progress_.wait(true); }
      ~Wait() { progress_.wait(false); }
      Wait(const Wait&) = delete;
      Wait& operator=(const Wait&) = delete;

     private:
      Entry& progress_;
    };

    explicit Entry(ProgressBoard& board) : board_(board) {}

   private:
    friend class ProgressBoard;
    void wait(bool waiting);
    ProgressBoard& board_;
    bool waiting_ = false;
    Clock::time_point last_step_ = Clock::now();
    std::vector<storage::ClaimedLoop> claims_;
    std::set<std::int64_t> lost_;  ///< loop_id
  };

  /// A place of its own, as long as the board lives.
  [[nodiscard]] Entry& entry();

  /// Claims of all workers that got on since renewed() was called last.
  [[nodiscard]] std::vector<storage::ClaimedLoop> proven_claims();
  /// Leases were extended for all that had got on by `seen`.
  void renewed(Clock::time_point seen);
  /// These claims are outdated; returns how many were still held here.
  std::size_t lose(std::span<const storage::ClaimKey> claims);
  /// Loops that all workers hold, lost ones included.
  [[nodiscard]] std::size_t held_loops();

  /// Why the process should not be trusted to work any more: a worker that holds loops and has
  /// shown nothing for longer than `limit`; nullopt = all is well.
  [[nodiscard]] std::optional<std::string> standstill(Clock::duration limit,
                                                      Clock::time_point now = Clock::now());
  /// Since the worker that is longest without a step, of those that hold loops and wait for no
  /// core, showed its last one; 0 = there is none.
  [[nodiscard]] Clock::duration longest_silence(Clock::time_point now = Clock::now());

 private:
  std::mutex mutex_;
  std::deque<Entry> entries_;  // their addresses stay
  Clock::time_point renewed_ = Clock::time_point::min();
};

}  // namespace loopscope::daemon
