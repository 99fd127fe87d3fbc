#pragma once

#include "storage/statement.hpp"

/// What ReportDatabase asks of shared oscillations.
namespace loopscope::storage::statements {

extern const Statement kPlantMembers;  ///< a row per member, event by event
extern const Statement kPlantLeads;    ///< a row per pair of an event, strongest first
extern const Statement kPlantTraces;  ///< a row per loop of an event that is drawn, strongest first
extern const Statement kFollowed;     ///< loop_id: the oscillation that the loop follows

}  // namespace loopscope::storage::statements
