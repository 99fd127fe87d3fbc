#include "storage/historian/check_index.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "storage/historian/index_advice.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

/// As kIndexes writes names, so that commas separate nothing else.
std::string hex(const std::string& name) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (const char character : name) {
    const auto byte = static_cast<std::uint8_t>(character);
    digits += {kDigits[byte / kDigits.size()], kDigits[byte % kDigits.size()]};
  }
  return digits;
}

std::vector<std::string> hex(std::vector<std::string> names) {
  for (std::string& name : names) name = hex(name);
  return names;
}

WantedIndex wanted_index(const SourceLayout& layout) {
  WantedIndex wanted;
  for (const KeyPart& part : layout.key) wanted.key.push_back(part.column);
  wanted.key.push_back(layout.time_column);
  // Rows of several values serve many tags at once: a covering index would be a second table.
  if (layout.shape == Shape::narrow) wanted.include = layout.value_columns;
  if (layout.shape == Shape::narrow && has_quality(layout))
    wanted.include.push_back(layout.quality_column);
  return wanted;
}

std::string plain_list(const std::vector<std::string>& columns, const std::string& comma = ", ") {
  std::string list;
  for (const std::string& column : columns) list += (list.empty() ? "" : comma) + column;
  return list;
}

/// Whether a comma-separated list starts with the wanted columns: the time last, the parts of the
/// key before it in any order.
bool starts_with_key(const std::string& columns, const WantedIndex& wanted) {
  const std::vector<std::string> key = hex(wanted.key);
  std::vector<std::string> first;
  std::istringstream rest(columns);
  for (std::string name; first.size() < key.size() && std::getline(rest, name, ',');) {
    first.push_back(name);
  }
  return first.size() == key.size() && first.back() == key.back() &&
         std::is_permutation(first.begin(), first.end(), key.begin());
}

bool holds_all(const std::string& columns, const std::vector<std::string>& wanted) {
  const std::string list = "," + columns + ",";
  return std::all_of(wanted.begin(), wanted.end(), [&list](const std::string& column) {
    return list.find("," + hex(column) + ",") != std::string::npos;
  });
}

/// MySQL and MariaDB have no INCLUDE, and the rows of a key that is not the primary one lie apart:
/// a window takes half as long from a key with all of its columns.
std::string index_behind(const ResolvedLayout& layout, const WantedIndex& wanted) {
  const bool narrow_row = layout.foreign && wanted.include.size() <= 2;
  const std::string key = plain_list(wanted.key);
  if (!narrow_row || wanted.include.empty()) return key;
  return key + ", " + plain_list(wanted.include);
}

/// A warning: what cannot be read in time without the index is found where a window is read.
Finding advise(const std::string& what, const IndexAdvice& advice) {
  return {true,
          what,
          "as the owner of the table, " + advice.owner + ", on the historian: " + advice.sql,
          true,
          advice.sql,
          advice.owner};
}

}  // namespace

Finding check_index(PqConnection& connection, const ResolvedLayout& layout) {
  const std::string& relation = layout.data.sql;
  const WantedIndex wanted = wanted_index(layout.layout);
  if (!layout.data.is_table) {
    return {
        true, relation + " is a view or a foreign table: its indexes were not checked",
        "make sure that the table behind it has an index on (" + index_behind(layout, wanted) + ")",
        true};
  }
  const PqRows rows =
      connection.run(historian_statements::kIndexes, {std::to_string(layout.data.oid)});
  bool has_key = false;
  for (int row = 0; row < rows.size(); ++row) {
    if (!starts_with_key(rows.text(row, 0), wanted)) continue;
    has_key = true;
    if (holds_all(rows.text(row, 1), wanted.include))
      return {true, "an index serves the reading of windows, " + relation, "", false};
  }
  const std::string key = plain_list(wanted.key);
  if (!has_key) {
    return advise("no index starts with (" + key +
                      "), so every window scans the table, which is slow, " + relation,
                  index_advice(connection, layout.data, wanted));
  }
  return advise("the index on (" + key +
                    ") does not include the value: where the rows of a tag lie far apart, reading "
                    "is up to three times slower than it could be, " +
                    relation,
                index_advice(connection, layout.data, wanted));
}

bool has_key_index(PqConnection& connection, const ResolvedLayout& layout) {
  if (!layout.data.is_table) return false;
  const WantedIndex wanted = wanted_index(layout.layout);
  const PqRows rows =
      connection.run(historian_statements::kIndexes, {std::to_string(layout.data.oid)});
  for (int row = 0; row < rows.size(); ++row) {
    // In this order: the loose scan looks for the next larger key.
    if ((rows.text(row, 0) + ",").starts_with(plain_list(hex(wanted.key), ",") + ",")) return true;
  }
  return false;
}

}  // namespace loopscope::storage
