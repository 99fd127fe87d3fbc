#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/repair/repair_windows.hpp"

namespace loopscope::core::repair {

/// A fault of one side of a repair: the family of verdicts that has most confidence.
struct StandingFault {
  std::string code;    ///< the family's most frequent verdict
  std::string family;  ///< as RepairWindow::family
  bool is_hardware = false;
  std::size_t windows = 0;  ///< of the side that name the family
  double sure = 0.0;        ///< mean confidence of these, 0 to 1
};

/// A side's windows in one word.
struct SideVerdict {
  std::optional<StandingFault> stands;  ///< faults have half of all confidence there
  std::string suspected;  ///< code that comes nearest where none stands; empty = none at all
};

/// Whether a fault of the family lies in valve or sensor, or in a curve that hardware has: what
/// is repaired, not tuned.
[[nodiscard]] bool names_hardware(std::string_view family);

/// How many windows name a fault of this family with `min_confidence` (0 to 1) or more.
[[nodiscard]] std::size_t windows_naming(std::span<const RepairWindow> windows,
                                         std::string_view family, double min_confidence);

/// Verdicts below `min_confidence`, and those without a fault, count against a fault.
[[nodiscard]] SideVerdict side_verdict(std::span<const RepairWindow> windows,
                                       double min_confidence);

}  // namespace loopscope::core::repair
