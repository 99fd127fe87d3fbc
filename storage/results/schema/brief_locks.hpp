#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Between two tries for a lock: two minutes in all. What holds it longer than that (a dump) is
/// waited for by the timer that starts maintain again.
inline constexpr std::array<std::chrono::seconds, 7> kPausesForLocks{
    {std::chrono::seconds{1}, std::chrono::seconds{2}, std::chrono::seconds{4},
     std::chrono::seconds{8}, std::chrono::seconds{15}, std::chrono::seconds{30},
     std::chrono::seconds{60}}};

/// Whether a lock was not to be had in time (55P03), or two waited for each other (40P01).
[[nodiscard]] bool lock_was_taken(const DatabaseError& error);

/// Lets the rest of the transaction wait for a lock for 200 ms only: everybody who asks for the
/// table after us, readers too, waits behind us as long.
void wait_briefly_for_locks(Transaction& transaction);

/// Session::transact() for work that locks tables which others use: in tries that wait for locks
/// briefly, with growing pauses in which the others go on; `work` is called once a try. Blocks for
/// the pauses. Throws at once what is no matter of locks, else what the last one threw.
template <typename Work>
auto transact_between_others(Session& session, Work&& work) {
  const auto attempt = [&] {
    return session.transact([&](Transaction& transaction) {
      wait_briefly_for_locks(transaction);
      return work(transaction);
    });
  };
  for (const std::chrono::seconds pause : kPausesForLocks) {
    try {
      return attempt();
    } catch (const DatabaseError& error) {
      if (!lock_was_taken(error)) throw;
    }
    std::this_thread::sleep_for(pause);
  }
  return attempt();
}

}  // namespace loopscope::storage
