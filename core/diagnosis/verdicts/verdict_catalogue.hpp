#pragma once

#include <span>
#include <string_view>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/plant/member_loop.hpp"

namespace loopscope::core::diagnosis {

/// All that is known of one verdict beforehand. The rows of the results schema (`verdict_kind`,
/// `fault_family`, the weights of `parameter`) are checked against these.
struct CatalogueEntry {
  VerdictCode code = VerdictCode::healthy;
  std::string_view name;    ///< the word of the contract
  double weight = 0.0;      ///< in the ranking, 0 to 1, before a site changes it; 0 = no fault
  std::string_view family;  ///< faults that one repair mends; empty = no fault
  plant::Fault blames = plant::Fault::none;  ///< what it tells neighbours with the same oscillation
  /// Valve and sensor faults: a controller behind one says nothing of its tuning, so that advice on
  /// tuning waits until the fault is mended.
  bool withholds_tuning = false;
  std::string_view meaning;  ///< in a list of verdicts
  std::string_view summary;  ///< one sentence about a loop
  std::string_view action;   ///< what to do next, for a work order
};

/// Every verdict, in the order of VerdictCode.
[[nodiscard]] std::span<const CatalogueEntry> catalogue();

[[nodiscard]] const CatalogueEntry& catalogue_entry(VerdictCode code);

/// A verdict in the catalogue's words, without reasons. `confidence` from 0 to 1.
[[nodiscard]] Verdict verdict_with(VerdictCode code, double confidence);

/// What is added to the action for a valve or sensor fault.
inline constexpr std::string_view kTuningWaits = " Do not retune before that is repaired.";

/// What the loop's own diagnosis tells the plant.
[[nodiscard]] plant::OwnFindings own_findings(const Verdict& verdict);

}  // namespace loopscope::core::diagnosis
