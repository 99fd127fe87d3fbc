#pragma once

#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/historian/narrow_layout.hpp"

namespace loopscope::storage {

/// Every tag name of a historian, sorted by bytes, each once. Over an index that starts with
/// (tag, time) it costs one probe a tag, whatever the number of rows; without one (and through a
/// view) the whole table is read. Throws DatabaseError.
[[nodiscard]] std::vector<std::string> list_tags(const ConnectionSettings& settings,
                                                 const NarrowLayout& layout);

}  // namespace loopscope::storage
