#pragma once

#include "storage/statement.hpp"

/// The statements on the log of maintenance work.
namespace loopscope::storage::statements {

extern const Statement kRefuseMaintenance;  ///< names, times, kinds, descriptions
extern const Statement kAddMaintenance;     ///< the same
extern const Statement kListMaintenance;    ///< whether of these names only, names

}  // namespace loopscope::storage::statements
