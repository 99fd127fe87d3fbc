#pragma once

#include "storage/statement.hpp"

/// What is done for all loops together: rounds over the plant, and the announcement of flags.
namespace loopscope::storage::statements {

extern const Statement kWritePlantRound;  ///< slot_end, revision, loops, oscillating, events
/// slot_end, revision, number, period_s, loop_ids, strengths, lags_s, source ("" = none),
/// statement, roles, scores, p ("" = none)
extern const Statement kWritePlantEvent;
extern const Statement kLockFlags;
extern const Statement kTakeRound;      ///< owner, seconds; no row = another has the turn
extern const Statement kGiveRoundBack;  ///< owner
extern const Statement kRoundHolder;
extern const Statement kTellListeners;  ///< flagged or confirmed, messages
extern const Statement kAnnounceFlags;

}  // namespace loopscope::storage::statements
