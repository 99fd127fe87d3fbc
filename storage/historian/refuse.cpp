#include "storage/historian/refuse.hpp"

#include "storage/error.hpp"

namespace loopscope::storage {

void refuse(const SourceLayout& layout, const std::string& what, const std::string& hint) {
  throw DatabaseError(what + ", historian " + layout.source + " (" + layout.relation + ")", hint,
                      Remedy::give_up);
}

void require_columns(const SourceLayout& layout, const std::string& relation,
                     const ColumnTypes& types, const std::vector<NamedColumn>& columns) {
  for (const auto& [setting, column] : columns) {
    if (types.contains(column)) continue;
    refuse(layout, "no column \"" + column + "\" in " + relation,
           "set `" + setting + "` to one of: " + list_of(types));
  }
}

}  // namespace loopscope::storage
