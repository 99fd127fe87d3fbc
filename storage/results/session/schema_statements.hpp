#pragma once

#include "storage/statement.hpp"

/// The statements on the schema itself: its version, its partitions, what is too old, who may do
/// what.
namespace loopscope::storage::statements {

extern const Statement kHasSchema;
extern const Statement kSchemaVersion;
extern const Statement kOldestProgram;
extern const Statement kFindSchemaOwner;
extern const Statement kBecomeOwner;
extern const Statement kMakeSchema;
extern const Statement kLockSchema;
extern const Statement kAppliedMigrations;
extern const Statement kRecordMigration;  ///< version, name, sha256
extern const Statement kMakePartitions;   ///< months
extern const Statement kGrantRights;
extern const Statement kExpiredPartitions;  ///< retention_months
extern const Statement kDropPartition;      ///< name
extern const Statement kDeleteOldRows;      ///< retention_months
extern const Statement kDeleteLostWorkers;
extern const Statement kDeleteOldCosts;
extern const Statement kCheckRights;

}  // namespace loopscope::storage::statements
