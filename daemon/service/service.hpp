#pragma once

#include <filesystem>

namespace loopscope::daemon {

/// The daemon: polls for due loops and brings them to their end on all workers until told to stop.
///
/// SIGTERM and SIGINT: no new claims, what is in hand is finished, return. SIGHUP: the settings
/// file is read again; a bad one is reported and the old one kept. A database that is away is
/// reported once and tried again after pauses that grow up to a poll. A second SIGTERM or SIGINT
/// ends the process. At the start it throws config::SettingsError when the file is bad, and
/// storage::DatabaseError when a connection string cannot be read.
void run_service(const std::filesystem::path& settings_file);

}  // namespace loopscope::daemon
