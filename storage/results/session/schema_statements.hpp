#pragma once

#include "storage/statement.hpp"

/// The statements on the schema itself: its version, its partitions, what is too old, who may do
/// what. Parameters -> columns.
namespace loopscope::storage::statements {

extern const Statement kHasSchema;        ///< -> boolean
extern const Statement kSchemaVersion;    ///< -> version, 0 = none; needs the schema
extern const Statement kOldestProgram;    ///< -> version of the oldest program that it serves
extern const Statement kFindSchemaOwner;  ///< login -> the members of SchemaOwner
extern const Statement kBecomeOwner;
extern const Statement
    kOwnerRights;  ///< -> database, login, owner ('' = no schema), owns, may_make
extern const Statement kMakeSchema;
extern const Statement kLockSchema;
extern const Statement kAppliedMigrations;  ///< -> version, name, sha256, by version
extern const Statement kRecordMigration;    ///< version, name, sha256
extern const Statement kMakePartitions;  ///< months, the running one included -> name of each made
/// timestamptz -> the same of its month and those up to this one, which is not made
extern const Statement kMakePastPartitions;
extern const Statement kPartitionMonths;  ///< -> first, last month ("2026-01"), '' = there is none
extern const Statement kGrantRights;
extern const Statement kExpiredPartitions;  ///< retention_months -> name
extern const Statement kDropPartition;      ///< name
extern const Statement kDeleteOldRows;      ///< retention_months
extern const Statement kDeleteLostWorkers;
extern const Statement kDeleteOldCosts;
extern const Statement kCheckRights;          ///< -> what, needed, granted
extern const Statement kCheckEngineerRights;  ///< -> what, granted

}  // namespace loopscope::storage::statements
