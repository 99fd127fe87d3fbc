#pragma once

#include <optional>
#include <string>

namespace loopscope::daemon {

/// What `--help` says of the option.
inline constexpr const char* kOnBehalfOfHelp =
    "In whose name (default: the operating system's user who runs this)";

/// What keeps a text from being a name: "is empty", "has blanks around the name", ...; empty =
/// nothing does.
[[nodiscard]] std::string name_complaint(const std::string& name);

/// In whose name something is entered: `said` (--on-behalf-of), else the name of the operating
/// system's user who runs this process, by its real user id: no environment variable changes it,
/// and under sudo it is root. nullopt = the system has no name for that id. Throws Failure (usage)
/// for what is no name: empty, longer than storage::kLongestOnBehalfOf, with blanks around it, or
/// with anything but printable UTF-8 of one line that shows something.
[[nodiscard]] std::optional<std::string> on_behalf_of(const std::optional<std::string>& said);

}  // namespace loopscope::daemon
