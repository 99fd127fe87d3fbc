#pragma once

#include "storage/statement.hpp"

/// What ReportDatabase asks. Times come back as microseconds since 1970, UTC; parameters that are
/// times are texts of timestamp_text().
namespace loopscope::storage::statements {

extern const Statement kReportNow;
extern const Statement kSmallLetters;    ///< a text
extern const Statement kReportCounts;    ///< since; of what is not on one of the two lists
extern const Statement kNotControlling;  ///< no parameter
extern const Statement kUnjudgedReasons;
extern const Statement kReportFlagged;
extern const Statement kReportLatest;   ///< loop name: the verdict of a loop that is not flagged
extern const Statement kReportHistory;  ///< loop_id, from
extern const Statement kReportRepairs;  ///< since
extern const Statement kRepairsOfLoop;  ///< loop_id
extern const Statement kHiddenLoops;
extern const Statement kLoopProblems;  ///< loop_id
extern const Statement kWhatIf;  ///< rate, dependence, least confidence; each empty = as it is set

}  // namespace loopscope::storage::statements
