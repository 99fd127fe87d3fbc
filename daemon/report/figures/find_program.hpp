#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace loopscope::daemon {

/// The first executable file of that name in the folders of `search_path` (as the variable PATH);
/// nullopt = none. Empty folders, which would mean the current one, are left out.
[[nodiscard]] std::optional<std::filesystem::path> find_program(std::string_view name,
                                                                std::string_view search_path);

}  // namespace loopscope::daemon
