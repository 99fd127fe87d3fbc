#pragma once

#include <span>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/results/catalogue/maintenance.hpp"
#include "tests/plants/diagnose_repair.hpp"

namespace loopscope::tests::repairs {

/// Writes loops, analyses and events as catalogue, worker and command line do, judges the repairs
/// as the daemon does, and returns what the view shows of each, in their order. The database has
/// the schema.
[[nodiscard]] std::vector<storage::MaintenanceRow> store_repairs(
    const storage::ConnectionSettings& database, std::span<const DiagnosedRepair> repairs);

}  // namespace loopscope::tests::repairs
