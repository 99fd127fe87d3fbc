#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// A claimed loop whose rows were read: its newest slot, and earlier ones that are stored already
/// and may have got late rows since.
struct LoopTask {
  const storage::ClaimedLoop* claim = nullptr;
  LoopInput newest;
  std::vector<LoopInput> earlier;
  double fetch_ms = 0.0;  ///< share of the batch's reading time
  /// The newest slot is that of the newest rows, because the historian's clock is wrong.
  bool by_rows = false;
};

/// Analyses that are stored, by loop and slot end.
class StoredAnalyses {
 public:
  StoredAnalyses() = default;
  explicit StoredAnalyses(const std::vector<storage::StoredDigest>& rows);
  /// nullptr when the slot is not stored.
  [[nodiscard]] const storage::StoredDigest* find(std::int64_t loop_id,
                                                  std::int64_t slot_end_us) const;

 private:
  std::map<std::pair<std::int64_t, std::int64_t>, storage::StoredDigest> rows_;
};

/// Slots before the newest one that are looked at again: those of the horizon that are stored and
/// were analysed with the settings in force (others keep what they were judged by). Newest first.
[[nodiscard]] std::vector<std::int64_t> slots_to_check(const storage::ClaimedLoop& claim,
                                                       std::int64_t newest_end_us,
                                                       const StoredAnalyses& stored, int horizon);

/// How loops are to be analysed.
struct AnalysisOrders {
  const config::Settings& settings;
  const std::string& settings_json;  ///< those of the analysis: provenance and part of the digest
  std::size_t enabled_loops = 0;     ///< in the catalogue: decides whether models take turns
};

/// Analyses every slot of the visit whose digest is not the stored one and says what to write.
/// Throws what core/ throws.
[[nodiscard]] storage::CompletedLoop complete_visit(const LoopTask& visit,
                                                    const StoredAnalyses& stored,
                                                    const AnalysisOrders& orders);

}  // namespace loopscope::daemon
