#include "daemon/setup/choose_layout.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/time_zones.hpp"
#include "core/text/counted.hpp"
#include "daemon/setup/recognise_layouts.hpp"
#include "daemon/setup/row_contents.hpp"
#include "daemon/setup/vendor_layouts.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::SeenColumn;

std::string names_of(const std::vector<storage::SeenTable>& tables) {
  constexpr std::size_t kMost = 20;
  std::vector<std::string> names;
  for (const auto& table : tables) names.push_back(table.schema + "." + table.name);
  const bool more = names.size() > kMost;
  names.resize(std::min(names.size(), kMost));
  return fmt::format("{}{}", fmt::join(names, ", "), more ? ", ..." : "");
}

const SeenColumn& column_of(const LayoutCandidate& layout, const std::string& name) {
  return *std::ranges::find(layout.data.columns, name, &SeenColumn::name);
}

std::string fill_quality(storage::HistorianSurvey& survey, LayoutCandidate& layout) {
  config::HistorianSettings& historian = layout.historian;
  if (historian.quality_column.empty()) return {};
  const QualityGuess guess = guess_quality(column_of(layout, historian.quality_column),
                                           survey.sample(layout.data, historian.quality_column));
  historian.quality_rule = guess.rule;
  historian.good_codes = guess.good_codes;
  historian.uncertain_codes = guess.uncertain_codes;
  historian.bad_codes = guess.bad_codes;
  if (guess.rule == "none") historian.quality_column.clear();
  return guess.note;
}

TimeGuess guess_time(storage::HistorianSurvey& survey, const LayoutCandidate& layout) {
  const config::HistorianSettings& historian = layout.historian;
  if (historian.time_kind == "epoch_ms")
    return guess_epoch(survey.sample(layout.data, historian.time_column));
  if (historian.time_kind == "timestamp_utc")
    return guess_zone(survey.seconds_behind_utc(layout.data, historian.time_column));
  return {historian.time_kind, ""};
}

/// Before a settings file with it is written. Without a database of zones the server has to say.
void require_zone(const std::string& zone) {
  if (zone.empty() || config::time_zone_names().empty() || config::is_time_zone(zone)) return;
  throw Failure(ExitCode::usage,
                fmt::format("--time-zone: \"{}\" is not the name of a time zone", zone),
                config::time_zone_hint(zone));
}

std::string fill_time(storage::HistorianSurvey& survey, const std::string& time_zone,
                      Questions& questions, LayoutCandidate& layout) {
  config::HistorianSettings& historian = layout.historian;
  const bool zoneless = historian.time_kind == "timestamp_utc";
  if (!time_zone.empty() && !zoneless) {
    throw Failure(ExitCode::usage,
                  fmt::format("--time-zone is for times without a zone, {} has the type {}",
                              historian.time_column, column_of(layout, historian.time_column).type),
                  "leave it out");
  }
  const TimeGuess guess =
      time_zone.empty() ? guess_time(survey, layout) : TimeGuess{"timestamp_local", ""};
  historian.time_kind = guess.kind;
  if (guess.kind != "timestamp_local") return guess.note;
  historian.time_zone =
      questions.text(time_zone, "--time-zone",
                     guess.note + ". Their zone, as PostgreSQL names it, e.g. Europe/Berlin", "");
  require_zone(historian.time_zone);
  return {};
}

}  // namespace

LayoutCandidate choose_layout(const std::vector<storage::SeenTable>& tables,
                              const LayoutWishes& wishes, Questions& questions) {
  if (tables.empty()) {
    throw Failure(ExitCode::unusable_data, "the historian's database has no tables",
                  "is dbname in --historian right? `psql -l` lists the databases of a server");
  }
  const std::vector<LayoutCandidate> found = recognise_layouts(tables, wishes);
  if (found.empty()) {
    throw Failure(
        ExitCode::unusable_data,
        fmt::format("no table of the historian looks like a history: {}", names_of(tables)),
        "say which it is: --table schema.table with --preset, --tag-column, --time-column, "
        "--value-column, or make a view of (tag, time, value, quality)");
  }
  std::size_t which = 0;
  if (found.size() > 1) {
    std::vector<std::string> lines;
    for (const LayoutCandidate& candidate : found) lines.push_back(describe(candidate));
    which = questions.choice(lines,
                             core::text::counted(found.size(), "table", "tables") +
                                 " of the historian look like a history",
                             "say which: --table schema.table, or --preset");
  }
  if (found[which].open.empty()) return found[which];
  throw Failure(ExitCode::usage,
                fmt::format("{}: {}", found[which].historian.table, found[which].open),
                describe(found[which]));
}

std::vector<std::string> look_at_rows(storage::HistorianSurvey& survey,
                                      const std::string& time_zone, Questions& questions,
                                      LayoutCandidate& layout) {
  if (is_vendor(layout.historian.preset)) return {};
  std::vector<std::string> notes{fill_time(survey, time_zone, questions, layout),
                                 fill_quality(survey, layout)};
  std::erase(notes, "");
  return notes;
}

}  // namespace loopscope::daemon
