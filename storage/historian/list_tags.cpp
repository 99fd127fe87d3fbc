#include "storage/historian/list_tags.hpp"

#include <algorithm>

#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

/// Without an index a table of billions of rows is read from end to end.
constexpr int kPatience_s = 1800;

bool has_tag_index(PqConnection& connection, const ResolvedLayout& layout) {
  if (!layout.is_table) return false;
  return connection
             .run(historian_statements::kIndexes,
                  {std::to_string(layout.relation_oid), layout.layout.tag_column,
                   layout.layout.time_column})
             .size() > 0;
}

}  // namespace

std::vector<std::string> list_tags(const ConnectionSettings& settings, const NarrowLayout& layout) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kPatience_s;
  PqConnection connection(reader);
  const ResolvedLayout resolved = resolve_layout(connection, layout);
  const PqRows rows = connection.run(has_tag_index(connection, resolved)
                                         ? historian_statements::list_tags(resolved)
                                         : historian_statements::distinct_tags(resolved));
  std::vector<std::string> tags;
  tags.reserve(static_cast<std::size_t>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) tags.push_back(rows.text(row, 0));
  std::ranges::sort(tags);
  return tags;
}

}  // namespace loopscope::storage
