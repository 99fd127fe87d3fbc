#pragma once

#include <string>

#include "core/diagnosis/evidence/evidence.hpp"

namespace loopscope::core::diagnosis {

/// How sure it is that setpoint and pv are in different units.
enum class UnitFinding {
  none,
  doubted,  ///< likelier than not, by where both lie
  shown,    ///< pv follows the setpoint's moves as the other unit has them
};

/// Rates of false findings: core/loop/MEASURED.md, "Setpoint and pv in different units".
[[nodiscard]] UnitFinding unit_finding(const Evidence& evidence);

/// What speaks for it, in one sentence; empty for `none`.
[[nodiscard]] std::string unit_reason(const Evidence& evidence);

/// The verdict's summary and action where it is shown.
[[nodiscard]] std::string unit_summary();
[[nodiscard]] std::string unit_action();

}  // namespace loopscope::core::diagnosis
