#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// A code of the results as people write it: "valve_stiction" is "valve stiction".
[[nodiscard]] std::string in_words(std::string_view code);
/// The same as a heading: "Valve stiction".
[[nodiscard]] std::string as_heading(std::string_view code);

}  // namespace loopscope::daemon
