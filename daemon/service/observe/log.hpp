#pragma once

#include "config/settings.hpp"

namespace loopscope::daemon {

/// Sets the program's log up: to standard error, one line an event, as text or as JSON objects with
/// the keys ts, level, pid, thread and message. No name that is in a message can start a line of
/// its own or steer a terminal: as text it is escaped (printable.hpp), as JSON it reads back exact.
/// May be called again while other threads log; times are UTC.
void set_up_log(const config::DaemonSettings& settings);

}  // namespace loopscope::daemon
