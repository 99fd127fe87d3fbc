#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/report/sections/chain_table.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Everything that is said of one loop.
struct LoopReport {
  storage::FlaggedRow row;
  std::vector<storage::HistoryPoint> history;
  std::vector<storage::HiddenRow> hidden;        ///< what keeps it from the list
  std::optional<storage::FollowedRow> followed;  ///< the shared oscillation that it follows
  std::vector<storage::DataProblemRow> problems;
  std::vector<storage::RepairRow> repairs;
  std::optional<LoopEvidence> evidence;  ///< nullopt = its window could not be read again
  std::vector<Picture> pictures;
  std::vector<StepPictures> chain;  ///< of the steps of the loop model
  std::string trouble;  ///< why there are no pictures of the window, a sentence; empty = there are
  TimeZone zone;        ///< of all times that are told
  std::string annotate_address;  ///< where people say something of it; empty = not on a page
};

/// One loop as HTML: cause, action, evidence, pictures, what led to the explanation and its errors,
/// data, repairs. A live page has a `trend` that takes the place of the picture of the whole window
/// where a script runs.
[[nodiscard]] Markup loop_section(const LoopReport& loop_report, const Markup& trend = {});

/// The table of the model's errors before and after each effect, and what is left; in `pv_unit`
/// where it is known (empty = not).
[[nodiscard]] Markup explanation_table(const core::model::Explanation& explanation,
                                       const std::string& pv_unit = {});

}  // namespace loopscope::daemon
