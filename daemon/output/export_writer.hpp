#pragma once

#include <string>

#include "storage/connection_settings.hpp"
#include "storage/results/reports/export_view.hpp"

namespace loopscope::daemon {

/// Writes a view to `file`, or to standard output for "-", row by row as they come: the size of a
/// view does not matter. A file is written whole or not at all (OutputFile). Throws Failure and
/// DatabaseError.
///
/// As CSV: a header, null and empty as nothing, names byte for byte; what a spreadsheet would take
/// for a formula (is_formula) has a quote before it, and standard error says how many.
void export_csv(const storage::ConnectionSettings& connection,
                const storage::ExportRequest& request, const std::string& file);

/// As a JSON array of objects, one to a line.
void export_json(const storage::ConnectionSettings& connection,
                 const storage::ExportRequest& request, const std::string& file);

}  // namespace loopscope::daemon
