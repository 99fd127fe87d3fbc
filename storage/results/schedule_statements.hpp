#pragma once

#include "storage/statement.hpp"

/// The statements on loopscope.schedule: who holds which loop until when. Arrays of loop_id and
/// fence name the claims.
namespace loopscope::storage::statements {

extern const Statement kClaimDue;           ///< owner, lease_s, limit
extern const Statement kClaimDueElsewhere;  ///< owner, lease_s, limit, sources that are left out
extern const Statement kClaimSuspect;       ///< owner, lease_s
extern const Statement kRestSuspects;
extern const Statement kClaimNext;   ///< owner, lease_s, limit, after loop_id
extern const Statement kExtend;      ///< loop_ids, fences, lease_s
extern const Statement kLostClaims;  ///< loop_ids, fences
extern const Statement
    kSeeWorker;                   ///< worker, version, algorithm_revision, held_loops, lost_leases
extern const Statement kRelease;  ///< loop_ids, fences
extern const Statement kReleaseOwned;  ///< owner
extern const Statement kRecallStray;   ///< settle_s
extern const Statement kComplete;      ///< loop_ids, fences, slot_ends, next_dues, has_records
extern const Statement kSetAside;      ///< loop_ids, fences, errors, retry_after_s, at_fault
extern const Statement kNextDue;
extern const Statement kMakeDue;  ///< loop_ids
extern const Statement kCountEnabled;

}  // namespace loopscope::storage::statements
