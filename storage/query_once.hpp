#pragma once

#include <optional>
#include <string>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// Asks over a connection of its own, made for the one question, where the connection at hand
/// cannot be asked itself: first column of the first row. nullopt where no answer comes within a
/// few seconds, or none at all; a NULL is an empty text. The session is as the login finds it:
/// `sql` names the schema of whatever it uses. Blocks that long. Throws like complete_conninfo.
[[nodiscard]] std::optional<std::string> query_once(const ConnectionSettings& settings,
                                                    const std::string& sql);

}  // namespace loopscope::storage
