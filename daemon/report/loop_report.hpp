#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/diagnosis/analysis_settings.hpp"
#include "daemon/report/evidence/window_source.hpp"
#include "daemon/report/sections/loop_section.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {

/// How far back a loop's history is shown before the slot that is told of.
inline constexpr std::int64_t kHistoryReachUs = std::int64_t{90} * 86'400 * 1'000'000;

/// What the results know of a loop whose newest verdict is `row`, told in `zone`. Throws
/// storage::DatabaseError.
[[nodiscard]] LoopReport read_loop_report(storage::ReportDatabase& database,
                                          const storage::FlaggedRow& row, const TimeZone& zone);

/// The figures of a report but those of the model's steps; those of its window only when it was
/// looked at again.
[[nodiscard]] std::vector<Figure> figures_of(const LoopReport& loop_report);

/// Looks at the window again and draws the pictures. What cannot be had is said in the report's
/// `trouble`: the other loops of a report are told of all the same.
void add_figures(LoopReport& loop_report, const storage::CatalogueEntry& loop,
                 const WindowSource::Reading& reading, const core::AnalysisSettings& settings,
                 const std::filesystem::path& gnuplot, const std::stop_token& stop = {});

}  // namespace loopscope::daemon
