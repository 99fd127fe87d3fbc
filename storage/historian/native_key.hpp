#pragma once

#include <optional>
#include <string>

namespace loopscope::storage {

/// SQL type that keys are sent as, so that the index of a column of that type (a name of pg_type)
/// can be used: text, int8, uuid, bpchar.
[[nodiscard]] std::string key_type(const std::string& column_type);

/// `key` as the type that key_type() gave takes it; nullopt when no row can have it (a word in a
/// column of numbers, bytes that are no text): such a tag is unknown and must not fail its whole
/// batch.
[[nodiscard]] std::optional<std::string> native_key(const std::string& key,
                                                    const std::string& type);

}  // namespace loopscope::storage
