#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/writes/loop_windows.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {

/// Inserts analysis rows, or updates those whose input has changed (another digest), and returns
/// loop_id, slot_end_us, input_revision (1 = inserted) and analysis_id of what it wrote: nothing
/// for a row that is stored already. Takes what upsert_parameters() makes.
[[nodiscard]] const Statement& upsert_analyses();

/// The measured columns of such rows as JSON objects, nothing stored: the same conversions without
/// keys, provenance and durations. Takes what analysis_parameters() makes.
[[nodiscard]] const Statement& measure_analyses();

/// The SQL expression of that object for a row of loopscope.analysis that goes by the name `row`.
[[nodiscard]] std::string measured_object(const std::string& row);

/// One array per column, in the order that the statement expects; every loop has a record.
[[nodiscard]] std::vector<std::string> analysis_parameters(
    const std::vector<const CompletedLoop*>& loops);

/// The same, and what the windows up to each record say together; nullopt leaves that NULL.
[[nodiscard]] std::vector<std::string> upsert_parameters(
    const std::vector<const CompletedLoop*>& loops,
    const std::vector<std::optional<Combined>>& combined);

}  // namespace loopscope::storage
