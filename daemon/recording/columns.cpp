#include "daemon/recording/columns.hpp"

#include <fmt/format.h>
#include <string>
#include <string_view>

#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

std::optional<std::size_t> find_column(const CsvTable& table, std::string_view name) {
  std::optional<std::size_t> found;
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    if (!same_word(trimmed(table.header[column]), name)) continue;
    if (found) {
      throw Failure(ExitCode::unusable_data,
                    fmt::format("{}, line 1: the column \"{}\" stands twice", table.name, name),
                    "keep the one that is meant and give the other another name");
    }
    found = column;
  }
  return found;
}

Failure header_failure(const CsvTable& table, const std::string& problem) {
  return {ExitCode::unusable_data,
          fmt::format("{}, line 1: the header has {}", table.name, problem),
          "name the columns, e.g. t_s,sp,pv,op, separated by commas"};
}

}  // namespace

Columns find_columns(const CsvTable& table) {
  const auto seconds = find_column(table, "t_s");
  const auto iso = find_column(table, "time");
  const auto pv = find_column(table, "pv");
  if (!seconds && !iso) throw header_failure(table, "neither \"t_s\" nor \"time\"");
  if (!pv) throw header_failure(table, "no \"pv\" column");
  Columns columns;
  columns.time = seconds ? *seconds : *iso;
  columns.absolute_time = !seconds;
  columns.pv = *pv;
  columns.sp = find_column(table, "sp");
  columns.op = find_column(table, "op");
  columns.mv = find_column(table, "mv");
  columns.mode = find_column(table, "mode");
  columns.quality = find_column(table, "quality");
  return columns;
}

}  // namespace loopscope::daemon
