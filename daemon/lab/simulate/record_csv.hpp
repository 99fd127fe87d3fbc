#pragma once

#include <string>

#include "core/simulate/loop.hpp"

namespace loopscope::daemon {

/// A simulated record as a recording that `analyze` reads: t_s,sp,pv and, where the record has
/// them, op and (when `with_mv`) mv. Numbers are the shortest that read back bit for bit.
[[nodiscard]] std::string record_csv(const core::simulate::LoopRecord& record, bool with_mv);

}  // namespace loopscope::daemon
