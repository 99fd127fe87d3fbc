#pragma once

#include <string>

#include "core/signal/loop_window.hpp"
#include "core/simulate/loop.hpp"

namespace loopscope::daemon {

/// A window as a recording that `analyze` reads: time (UTC) and the columns that were recorded,
/// every number with the digits that bring it back to the last bit; missing samples are empty.
[[nodiscard]] std::string window_csv(const core::signal::LoopWindow& window);

/// A simulated record as a recording that `analyze` reads: t_s,sp,pv and, where the record has
/// them, op and (when `with_mv`) mv. Numbers are the shortest that read back bit for bit.
[[nodiscard]] std::string record_csv(const core::simulate::LoopRecord& record, bool with_mv);

}  // namespace loopscope::daemon
