#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// A sentence of the diagnosis, or the unit of a figure, with the catalogue's unit of pv in place
/// of "units of pv", "pv units" and "pv per %"; "units of pv" where the catalogue says none
/// (empty).
[[nodiscard]] std::string in_pv_unit(std::string_view text, const std::string& pv_unit);

}  // namespace loopscope::daemon
