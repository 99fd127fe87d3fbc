#pragma once

#include <vector>

#include "storage/catalogue_entry.hpp"
#include "storage/loop_work.hpp"
#include "tests/plants/repair.hpp"

namespace loopscope::tests::repairs {

/// A repair as the results database sees it.
struct DiagnosedRepair {
  storage::CatalogueEntry loop;
  std::string fault;
  Word word = Word::unchanged;
  std::string event_kind, work;
  std::int64_t done_at_us = 0;
  std::vector<storage::AnalysisRecord> before;  ///< newest first
  std::vector<storage::AnalysisRecord> after;   ///< oldest first
};

/// The analyses of all windows by the worker's own steps; the work was done between the windows.
[[nodiscard]] DiagnosedRepair diagnose_repair(const Repair& repair, const std::string& loop_name);

}  // namespace loopscope::tests::repairs
