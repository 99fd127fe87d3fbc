#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "storage/results/reports/listed_loops.hpp"

namespace loopscope::daemon {

/// By what a list of loops is in order; loops that are equal in it, or have none, by rank and name.
enum class LoopOrder { rank, name, area, unit, verdict, confidence, state, window };

/// Their names, in that order.
[[nodiscard]] const std::vector<std::string>& loop_orders();

/// flagged, off the list, not flagged, never analysed, disabled: each loop has one of them.
[[nodiscard]] const std::vector<std::string>& loop_states();

/// Which loops of the catalogue are wanted; an empty text asks for any.
struct LoopQuery {
  std::string part = {};  ///< of the name, the description or the owner, whatever the case (as the
                          ///< database knows it)
  std::string area = {}, unit = {};
  std::string verdict = {};  ///< as it is shown: a code; "none" = never analysed
  std::string state = {};    ///< one of loop_states()
  LoopOrder order = LoopOrder::rank;
  bool backwards = false;  ///< the last ones first; those that have none stay behind
  std::int64_t skip = 0;   ///< rows before the first that is wanted, 0 and more
  std::int64_t most = 0;   ///< rows, 1 and more
};

/// What a page of such a list shows.
struct LoopListing {
  std::vector<storage::LoopRow> loops = {};  ///< views into the catalogue's
  std::int64_t skip = 0;                     ///< rows before the first of these
  std::int64_t fitting = 0;                  ///< loops that are asked for, on all pages
  std::int64_t all = 0;                      ///< of the catalogue
  /// What can be asked for: each that a loop of the catalogue has, in order.
  std::vector<std::string> areas = {}, units = {}, verdicts = {};
};

/// A page of `loops`, which are by rank and name (ReportDatabase::loops). `part` is that of the
/// query in small letters. Behind the last page that one.
[[nodiscard]] LoopListing choose_loops(const storage::ListedLoops& loops, const LoopQuery& query,
                                       const std::string& part);

LoopListing choose_loops(storage::ListedLoops&& loops, const LoopQuery& query,
                         const std::string& part) = delete;

/// A loop's verdict as it is shown, of one that others shake "external_disturbance"; "none" = it
/// was never analysed.
[[nodiscard]] std::string_view shown_verdict(const storage::LoopRow& loop);

}  // namespace loopscope::daemon
