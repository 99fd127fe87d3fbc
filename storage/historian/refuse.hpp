#pragma once

#include <string>
#include <utility>
#include <vector>

#include "storage/historian/column_types.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// Throws DatabaseError (give_up): the layout does not fit its database.
[[noreturn]] void refuse(const SourceLayout& layout, const std::string& what,
                         const std::string& hint);

/// Setting and the column that it names.
using NamedColumn = std::pair<std::string, std::string>;

/// Refuses when one of the columns is not among `types`.
void require_columns(const SourceLayout& layout, const std::string& relation,
                     const ColumnTypes& types, const std::vector<NamedColumn>& columns);

}  // namespace loopscope::storage
