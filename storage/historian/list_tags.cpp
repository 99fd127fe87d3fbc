#include "storage/historian/list_tags.hpp"

#include <algorithm>
#include <set>

#include "storage/historian/check_index.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"
#include "storage/historian/tag_value.hpp"

namespace loopscope::storage {
namespace {

/// Without an index a table of billions of rows is read from end to end.
constexpr int kListTimeout_s = 1800;

/// The columns of a loop_row or wide table that can be values.
std::vector<std::string> value_columns(const PqConnection& connection,
                                       const ResolvedLayout& layout) {
  const SourceLayout& names = layout.layout;
  std::set<std::string> others{names.time_column, names.nanos_column, names.quality_column,
                               names.tiebreak_column};
  for (const KeyPart& part : names.key) others.insert(part.column);
  std::vector<std::string> columns;
  for (const auto& [column, type] : layout.data.types) {
    if (!others.contains(column) && value_of(connection, layout, column)) columns.push_back(column);
  }
  return columns;
}

/// The parts of every key, joined.
std::vector<std::string> joined(const PqRows& rows, std::size_t parts,
                                const std::string& separator) {
  std::vector<std::string> keys;
  for (int row = 0; row < rows.size(); ++row) {
    std::string key;
    for (std::size_t part = 0; part < parts; ++part) {
      key += (part == 0 ? "" : separator) + rows.text(row, static_cast<int>(part));
    }
    keys.push_back(std::move(key));
  }
  return keys;
}

std::vector<std::string> list_keys(PqConnection& connection, const ResolvedLayout& layout) {
  const auto& key = layout.key;
  if (key.size() == 1 && key.front().names) {
    return joined(connection.run(historian_statements::list_names(*key.front().names)), 1, "");
  }
  const bool loose_scan = has_key_index(connection, layout);
  return joined(
      connection.run(historian_statements::list_keys(layout, layout.data.sql, loose_scan)),
      key.size(), layout.layout.separator);
}

}  // namespace

std::vector<std::string> list_tags(const ConnectionSettings& settings, const SourceLayout& layout) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kListTimeout_s;
  PqConnection connection(reader);
  const ResolvedLayout resolved = resolve_layout(connection, layout);
  std::vector<std::string> tags;
  if (layout.shape == Shape::wide) {
    tags = value_columns(connection, resolved);
  } else if (layout.shape == Shape::narrow) {
    tags = list_keys(connection, resolved);
  } else {
    const std::vector<std::string> columns = value_columns(connection, resolved);
    for (const std::string& key : list_keys(connection, resolved)) {
      for (const std::string& column : columns) tags.push_back(key + layout.separator + column);
    }
  }
  std::ranges::sort(tags);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

}  // namespace loopscope::storage
