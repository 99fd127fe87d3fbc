#include "daemon/recording/columns.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "config/nearest_name.hpp"
#include "daemon/recording/column_names.hpp"
#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using Header = std::vector<std::string>;
/// Columns by role; a role without one is not there.
using ColumnPlaces = std::map<std::string_view, std::size_t>;

constexpr const char* kSayColumns =
    "say which columns they are: --columns time=NAME,pv=NAME,sp=NAME,op=NAME (t_s=NAME where the "
    "time is in seconds)";

/// A message shows so many names.
constexpr std::size_t kMostShown = 12;

std::string columns_text(const Header& header, char separator) {
  std::string text;
  for (std::size_t k = 0; k < std::min(header.size(), kMostShown); ++k)
    text += (text.empty() ? "" : ", ") + shown(trimmed(header[k]));
  if (header.size() > kMostShown) text += fmt::format(" and {} more", header.size() - kMostShown);
  return fmt::format("{} (separated by {})", text, separators_text(separator));
}

Failure header_failure(const CsvTable& table, const std::string& problem, const std::string& hint) {
  return {ExitCode::unusable_data, fmt::format("{}, line 1: {}", table.name, problem), hint};
}

std::optional<std::size_t> find_column(const CsvTable& table, std::string_view name) {
  std::optional<std::size_t> found;
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    if (!same_word(trimmed(table.header[column]), name)) continue;
    if (found)
      throw header_failure(table, fmt::format("the column {} stands twice", shown(name)),
                           "keep the one that is meant and give the other another name");
    found = column;
  }
  return found;
}

/// The columns that `form` says by name.
ColumnPlaces said_columns(const CsvTable& table, const RecordingForm& form) {
  ColumnPlaces places;
  for (const auto& [role, name] : form.columns) {
    const auto column = find_column(table, name);
    if (!column) {
      Header known;
      for (const std::string& cell : table.header) known.emplace_back(trimmed(cell));
      const auto nearest = config::nearest_name(name, known);
      throw header_failure(
          table,
          fmt::format("no column {}, which --columns names as {}: the header has {}", shown(name),
                      role, columns_text(table.header, table.separator)),
          nearest ? fmt::format("did you mean {}?", shown(*nearest))
                  : "write the name as it stands in the header");
    }
    places[*std::ranges::find(kColumnRoles, role)] = *column;
  }
  return places;
}

bool is_complete(const ColumnPlaces& places) {
  return places.contains("pv") && (places.contains("time") || places.contains("t_s"));
}

bool is_taken(const ColumnPlaces& places, std::size_t column) {
  return std::ranges::any_of(places, [&](const auto& place) { return place.second == column; });
}

struct OtherName {
  NamedColumn named;
  std::size_t column = 0;
};

/// Columns whose name says a role that has none yet.
std::vector<OtherName> candidates_in(const Header& header, const ColumnPlaces& places) {
  std::vector<OtherName> candidates;
  for (std::size_t column = 0; column < header.size(); ++column) {
    const auto named = read_column_name(header[column]);
    if (named && !places.contains(named->role) && !is_taken(places, column))
      candidates.push_back({*named, column});
  }
  return candidates;
}

Failure two_candidates(const CsvTable& table, const OtherName& one, const OtherName& other) {
  return header_failure(
      table,
      fmt::format("{} and {} may both be the column {}", shown(trimmed(table.header[one.column])),
                  shown(trimmed(table.header[other.column])), one.named.role),
      fmt::format("say which is meant: --columns {}={}", one.named.role,
                  trimmed(table.header[one.column])));
}

/// The only candidate of a role, of those of one loop where it is given.
std::optional<OtherName> only_candidate(const CsvTable& table,
                                        const std::vector<OtherName>& candidates,
                                        std::string_view role,
                                        const std::optional<std::string>& loop) {
  std::optional<OtherName> only;
  for (const OtherName& candidate : candidates) {
    if (candidate.named.role != role || (loop && candidate.named.loop != *loop)) continue;
    if (only) throw two_candidates(table, *only, candidate);
    only = candidate;
  }
  return only;
}

/// What other spellings add. Signals are taken of pv's loop alone: a file may hold several.
void add_other_names(const CsvTable& table, ColumnPlaces& places) {
  const std::vector<OtherName> candidates = candidates_in(table.header, places);
  const auto take = [&](std::string_view role, const std::optional<std::string>& loop) {
    const auto candidate = only_candidate(table, candidates, role, loop);
    if (candidate) places[role] = candidate->column;
    return candidate;
  };
  if (!places.contains("time") && !places.contains("t_s") && !take("time", {})) take("t_s", {});
  const auto pv = take("pv", {});
  // Of a pv that was said by name the loop is not known.
  const std::string loop = pv ? pv->named.loop : "";
  for (const std::string_view role : {"sp", "op", "mv", "mode", "quality"}) take(role, loop);
}

ColumnPlaces places_in(const CsvTable& table, const RecordingForm& form) {
  ColumnPlaces places = said_columns(table, form);
  const ColumnPlaces said = places;
  for (const std::string_view role : kColumnRoles) {
    const auto column = find_column(table, role);
    if (column && !is_taken(said, *column)) places.emplace(role, *column);
  }
  // The time that was said goes before one that has its name.
  if (said.contains("time") && !said.contains("t_s")) places.erase("t_s");
  if (!form.columns.empty() || !is_complete(places)) add_other_names(table, places);
  return places;
}

std::optional<std::size_t> place_of(const ColumnPlaces& places, std::string_view role) {
  const auto found = places.find(role);
  return found == places.end() ? std::nullopt : std::optional(found->second);
}

bool has_other_name(const CsvTable& table, std::string_view role, std::optional<std::size_t> at) {
  return at && !same_word(trimmed(table.header[*at]), role);
}

/// Roles and columns, as sentences name them.
std::vector<std::pair<std::string_view, std::optional<std::size_t>>> roles_of(
    const Columns& columns) {
  return {{columns.absolute_time ? "time" : "t_s", columns.time},
          {"sp", columns.sp},
          {"pv", columns.pv},
          {"op", columns.op},
          {"mv", columns.mv},
          {"mode", columns.mode},
          {"quality", columns.quality}};
}

}  // namespace

Columns find_columns(const CsvTable& table, const RecordingForm& form) {
  const ColumnPlaces places = places_in(table, form);
  const std::string seen = columns_text(table.header, table.separator);
  const auto seconds = place_of(places, "t_s");
  const auto time = place_of(places, "time");
  const auto pv = place_of(places, "pv");
  if (!seconds && !time)
    throw header_failure(table, "the header has neither \"t_s\" nor \"time\", but " + seen,
                         kSayColumns);
  if (!pv) throw header_failure(table, "the header has no \"pv\" column, but " + seen, kSayColumns);
  Columns columns;
  columns.time = seconds ? *seconds : *time;
  columns.absolute_time = !seconds;
  columns.pv = *pv;
  columns.sp = place_of(places, "sp");
  columns.op = place_of(places, "op");
  columns.mv = place_of(places, "mv");
  columns.mode = place_of(places, "mode");
  columns.quality = place_of(places, "quality");
  columns.by_other_names = std::ranges::any_of(roles_of(columns), [&](const auto& role) {
    return has_other_name(table, role.first, role.second);
  });
  return columns;
}

bool is_header_of_recording(const Header& header, const RecordingForm& form) {
  const auto stands = [&](const auto& said) {
    return std::ranges::any_of(
        header, [&](const std::string& cell) { return same_word(trimmed(cell), said.second); });
  };
  if (!std::ranges::all_of(form.columns, stands)) return false;
  try {
    return is_complete(places_in({"", header, {}}, form));
  } catch (const Failure&) {
    // A column that stands twice is one for all that: the reader is told which.
    return header.size() > 1;
  }
}

std::vector<std::string> column_notes(const CsvTable& table, const Columns& columns) {
  std::vector<std::string> notes;
  std::string read;
  ColumnPlaces places;
  for (const auto& [role, at] : roles_of(columns)) {
    if (!at) continue;
    places[role] = *at;
    read += fmt::format("{}{} is {}", read.empty() ? "" : ", ", role,
                        shown(trimmed(table.header[*at])));
  }
  if (columns.by_other_names) notes.push_back(read);
  for (const auto& [named, column] : candidates_in(table.header, places)) {
    if (named.role == "time" || named.role == "t_s") continue;
    const std::string name = shown(trimmed(table.header[column]));
    notes.push_back(fmt::format("the column {} is not read; --columns {}={} reads it", name,
                                named.role, trimmed(table.header[column])));
  }
  return notes;
}

}  // namespace loopscope::daemon
