#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// The type of a loop by the letters of its name after ISA 5.1 (FIC, 21FC005, LIC_101, PDIC-7):
/// flow, level, temperature, pressure or analysis; empty = the name does not say. The last such
/// group of letters counts, since areas and units come first.
[[nodiscard]] std::string loop_type_of(std::string_view name);

}  // namespace loopscope::daemon
