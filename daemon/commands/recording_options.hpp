#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "daemon/recording/recording.hpp"

namespace loopscope::daemon {

/// The recording of a command line: its file, and what is said of it.
struct RecordingOptions {
  std::string file;
  std::string columns;
  std::string decimal_sign;
  std::string date_order;
};

/// Adds FILE and the options that say what a file does not show itself.
void add_recording_options(CLI::App& command, RecordingOptions& options);

/// The file, read, times without an offset in `zone`; what a reader should know of how it was
/// understood goes to standard error. Throws as read_recording() and parse_columns().
[[nodiscard]] Recording read_recording(const RecordingOptions& options, const TimeZone& zone);

}  // namespace loopscope::daemon
