#pragma once

#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// Every tag name of a historian as loops refer to it, sorted by bytes, each once.
///
/// Names come out of the table of names where a tag has one part and such a table is set: all of
/// them, with rows or without. Else the keys are looked for among the rows: over an index that
/// starts with key and time one probe a key, whatever the number of rows; without one (and through
/// a view) the whole table is read. The tags of a loop_row or wide table are its columns that hold
/// numbers or texts. A statement may take half an hour. Throws DatabaseError.
[[nodiscard]] std::vector<std::string> list_tags(const ConnectionSettings& settings,
                                                 const SourceLayout& layout);

}  // namespace loopscope::storage
