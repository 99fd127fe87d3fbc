#include "storage/historian/tag_value.hpp"

#include <vector>

#include "storage/historian/value_sql.hpp"

namespace loopscope::storage {
namespace {

/// COALESCE over the columns of a narrow row, or the one column of the tag.
std::string bare_value(const PqConnection& connection, const ResolvedLayout& layout,
                       const std::vector<std::string>& columns) {
  std::string list;
  for (const std::string& column : columns) {
    const std::string sql = value_sql(connection, "h." + connection.quote(column),
                                      layout.data.types.at(column), layout.layout.states);
    list += (list.empty() ? "" : ", ") + sql;
  }
  return columns.size() == 1 ? list : "COALESCE(" + list + ")";
}

/// A local time that stands for two moments (the hour that the end of summer time repeats): the
/// database takes it for the later one, so the earlier one reads the same on the clock.
std::string unambiguous(const ResolvedLayout& layout) {
  const std::string at_zone = " AT TIME ZONE " + layout.zone;
  return "((" + layout.time + at_zone + ") - interval '1 hour')" + at_zone + " <> " + layout.time;
}

}  // namespace

std::optional<std::string> value_of(const PqConnection& connection, const ResolvedLayout& layout,
                                    const std::string& column) {
  const bool narrow = layout.layout.shape == Shape::narrow;
  if (!narrow) {
    const auto found = layout.data.types.find(column);
    if (found == layout.data.types.end()) return std::nullopt;
    if (!is_number_type(found->second) && !is_text_type(found->second)) return std::nullopt;
  }
  const std::string value =
      bare_value(connection, layout, narrow ? layout.layout.value_columns : std::vector{column});
  std::string condition = layout.quality.good;
  if (!layout.zone.empty()) {
    condition = (condition.empty() ? "" : "(" + condition + ") AND ") + unambiguous(layout);
  }
  if (condition.empty()) return value;
  const std::string otherwise = layout.layout.null_is_absent ? " ELSE 'NaN'" : "";
  return "CASE WHEN " + condition + " THEN " + value + otherwise + " END";
}

}  // namespace loopscope::storage
