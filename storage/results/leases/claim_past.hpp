#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// Loops that are to be claimed for slots of the past, and who claims them.
struct PastClaim {
  std::string owner;     ///< host/pid
  double lease_s = 0.0;  ///< > 0, up to 1 000 000
  /// Seconds, >= 0: as long as any worker was seen within `lease_s`, only loops are claimed that
  /// nobody holds and that are not due for so long, or for half of their period.
  double reserve_s = 0.0;
  std::vector<std::pair<std::int64_t, std::int64_t>> loop_and_slot;  ///< loop_id, slot_end_us
};

/// ResultsDatabase::claim_past(). Throws DatabaseError.
[[nodiscard]] std::vector<ClaimedLoop> claim_past(Session& session, const ClockCheck& check,
                                                  const PastClaim& claim);

/// Gives such claims back: the loop is due when it was before. `keys` are three arrays: of loop_id,
/// of fence, and of the time. Returns the loops whose claim still held. In the caller's
/// transaction, by Session::transact().
[[nodiscard]] std::vector<std::int64_t> give_back_past(Transaction& transaction,
                                                       const std::vector<std::string>& keys);

}  // namespace loopscope::storage
