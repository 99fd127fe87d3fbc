#pragma once

#include "storage/statement.hpp"

/// What people say about findings. A code that is empty means: whatever the verdict.
namespace loopscope::storage::statements {

extern const Statement kListAnnotations;
extern const Statement kReplaceAnnotations;   ///< loop name, kind, code
extern const Statement kAddAnnotation;        ///< loop name, kind, code, until ("" = none), reason
extern const Statement kWithdrawAnnotations;  ///< loop name, code ("" = every annotation)
extern const Statement kNewestCode;           ///< loop name
extern const Statement kFaultCodes;

}  // namespace loopscope::storage::statements
