#pragma once

#include <optional>
#include <string>

#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// SQL of the double that a tag's row holds, its quality included: NULL for bad ones (NaN where the
/// layout says that NULL is no row). `column` is the tag's own in loop_row and wide tables and
/// empty in narrow ones; nullopt when there is no such column or it holds nothing that reads as a
/// number. Throws DatabaseError for a name that cannot be quoted.
[[nodiscard]] std::optional<std::string> value_of(const PqConnection& connection,
                                                  const ResolvedLayout& layout,
                                                  const std::string& column);

}  // namespace loopscope::storage
