#pragma once

#include "storage/statement.hpp"

/// The closed list of statements on the results database, those on the schedule and
/// the schema apart (schedule_statements.hpp, schema_statements.hpp). (The one that writes analysis
/// rows is made from the table of columns: analysis_columns.hpp. Migrations are files.)
namespace loopscope::storage::statements {

// results
extern const Statement kStoredDigests;   ///< loop_ids, slot_ends, algorithm_revision, settings
extern const Statement kInsertVerdicts;  ///< keys, analysis_ids, codes, ... (one array per column)
extern const Statement kInsertPeaks;     ///< keys, ranks, f1, f2, bic2, p
extern const Statement kInsertSteps;     ///< keys, models as JSON objects with "steps"
extern const Statement kNoteProblems;    ///< loop_ids, codes, roles, slots, ... (arrays)
extern const Statement kSetParameter;    ///< name, value
extern const Statement kAddStageCost;    ///< host, lane, then StageCost member by member

// catalogue
extern const Statement kListLoops;
extern const Statement kFindLoop;    ///< name
extern const Statement kSaveLoops;   ///< one array per column
extern const Statement kSetEnabled;  ///< names, enabled

// maintenance
extern const Statement kRefuseMaintenance;  ///< names, times, kinds, descriptions
extern const Statement kAddMaintenance;     ///< the same
extern const Statement kListMaintenance;    ///< whether of these names only, names

}  // namespace loopscope::storage::statements
