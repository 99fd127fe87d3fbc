#pragma once

#include "storage/statement.hpp"

/// The statements on loopscope.schedule: who holds which loop until when. Arrays of loop_id and
/// fence name the claims.
namespace loopscope::storage::statements {

extern const Statement kClaimDue;  ///< owner, lease_s, limit, after due_us and loop_id
/// The same, and sources that are left out.
extern const Statement kClaimDueElsewhere;
extern const Statement kOldestDue;     ///< from due_us, to due_us and loop_id, left out
extern const Statement kClaimSuspect;  ///< owner, lease_s
extern const Statement kRestSuspects;
extern const Statement kClaimNext;   ///< owner, lease_s, limit, after loop_id
extern const Statement kExtend;      ///< loop_ids, fences, lease_s
extern const Statement kLostClaims;  ///< loop_ids, fences
extern const Statement
    kSeeWorker;                   ///< worker, version, algorithm_revision, held_loops, lost_leases
extern const Statement kRelease;  ///< loop_ids, fences
extern const Statement kReleaseOwned;  ///< owner
extern const Statement kShortestPeriod;
extern const Statement kFindStray;  ///< settle_s, shortest period_s
extern const Statement kRecall;     ///< loop_ids, fences, visible_ats, slot_ends
/// loop_ids, fences, slot_ends, next_dues, has_records, what is known of pv (seconds, pv units)
extern const Statement kComplete;
extern const Statement kSetAside;  ///< loop_ids, fences, errors, retry_after_s, at_fault
extern const Statement kNextDue;   ///< after due_us and loop_id, within_s
extern const Statement kMakeDue;   ///< loop_ids
extern const Statement kCountEnabled;

}  // namespace loopscope::storage::statements
