#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/leases/claim_watermark.hpp"
#include "storage/results/session/session.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

// Every function makes its own transactions on `session`, none of which is open afterwards, and
// throws DatabaseError.

/// Who claims what, and for how long.
struct DueClaim {
  std::string owner;                ///< host/pid
  double lease_s = 0.0;             ///< > 0, up to 1 000 000
  int limit = 0;                    ///< > 0
  std::vector<std::string> but_of;  ///< sources that are left out
  std::size_t sharers = 1;          ///< batch_share() of what is due; 1 = up to the limit
};

/// ResultsDatabase::claim_due(). Before the first claim, and where nothing is found from the
/// watermark on, it looks back.
[[nodiscard]] std::vector<ClaimedLoop> claim_due(Session& session, const ClockCheck& check,
                                                 const DueClaim& claim, ClaimWatermark& watermark);

/// ResultsDatabase::claim_suspect(): one loop at most.
[[nodiscard]] std::vector<ClaimedLoop> claim_suspect(Session& session, const ClockCheck& check,
                                                     const std::string& owner, double lease_s);

/// A claim in the order of the catalogue.
struct NextClaim {
  std::string owner;  ///< as in DueClaim, as are the next two
  double lease_s = 0.0;
  int limit = 0;
  std::int64_t after = 0;  ///< loop_id
};

/// ResultsDatabase::claim_next().
[[nodiscard]] std::vector<ClaimedLoop> claim_next(Session& session, const ClockCheck& check,
                                                  const NextClaim& claim);

/// Looks for loops that are due and lie before the watermark, and lowers it to the oldest: in the
/// nearest slice, then in further ones back in time until the beginning of time is reached, or the
/// server has worked for 30 ms (the first time a second); the next call goes on from there. Returns
/// whether one was found.
bool look_back(Session& session, const std::vector<std::string>& but_of, ClaimWatermark& watermark);

}  // namespace loopscope::storage
