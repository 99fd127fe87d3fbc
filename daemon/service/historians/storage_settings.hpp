#pragma once

#include <map>
#include <string>

#include "config/settings.hpp"
#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::daemon {

/// The settings file's words as storage/ wants them: the two rooms do not know each other. A word
/// that passed validation and is not known here throws std::logic_error.

/// The worker's connection: no wait takes longer than a third of what a claim holds.
[[nodiscard]] storage::ConnectionSettings results_connection(const config::Settings& settings);
/// The schema owner's connection (migrate, maintain, loops, import).
[[nodiscard]] storage::ConnectionSettings owner_connection(const config::Settings& settings);
/// The connection under which people speak (annotate, maintenance).
[[nodiscard]] storage::ConnectionSettings engineer_connection(const config::Settings& settings);
/// The results for somebody who only reads them (report, export): no lease waits for him.
[[nodiscard]] storage::ConnectionSettings reader_connection(const config::Settings& settings);
[[nodiscard]] storage::ConnectionSettings historian_connection(
    const config::HistorianSettings& historian);
/// The same for a worker that holds loops for `hold_s` seconds: no wait takes longer than a third
/// of that.
[[nodiscard]] storage::ConnectionSettings historian_connection(
    const config::HistorianSettings& historian, double hold_s);
/// The connection that may write into the historian (import).
[[nodiscard]] storage::ConnectionSettings historian_writer_connection(
    const config::HistorianSettings& historian);
[[nodiscard]] storage::SourceLayout historian_layout(const config::HistorianSettings& historian);

/// The historian of that name. Throws Failure (configuration) when the settings have none.
[[nodiscard]] const config::HistorianSettings& find_historian(const config::Settings& settings,
                                                              const std::string& name);

}  // namespace loopscope::daemon
