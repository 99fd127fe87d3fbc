#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {

// All work in the caller's transaction, which Session::transact() commits and whose errors it puts
// into DatabaseError.

/// ResultsDatabase::extend().
std::vector<ClaimKey> extend(Transaction& transaction, std::span<const ClaimedLoop> claimed,
                             double lease_s);

/// ResultsDatabase::release().
void release(Transaction& transaction, std::span<const ClaimedLoop> claimed);
/// The same; `keys` are the two arrays that name the claims: of loop_id and of fence.
void release(Transaction& transaction, const std::vector<std::string>& keys);

/// ResultsDatabase::release_owned().
void release_owned(Transaction& transaction, const std::string& owner);

/// ResultsDatabase::recall_stray().
std::size_t recall_stray(Transaction& transaction, double settle_s);

}  // namespace loopscope::storage
