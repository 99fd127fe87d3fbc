#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// What the name of a column says beside the names of contract.md.
struct NamedColumn {
  std::string_view role;  ///< of kColumnRoles
  std::string loop;       ///< what stands before the word: "FIC101" in "FIC101.PV"; may be empty
};

/// "Setpoint", "FIC101.SP [m3/h]", "Sollwert", "Timestamp", "Time (s)": case, blanks, points, lines
/// and a unit in brackets count for nothing. nullopt for a name that says nothing for certain.
[[nodiscard]] std::optional<NamedColumn> read_column_name(std::string_view name);

}  // namespace loopscope::daemon
