#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/observe/stage_driver.hpp"
#include "daemon/service/shared/kept_errors.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "storage/catalogue_entry.hpp"
#include "storage/loop_work.hpp"
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

/// Which windows get a loop model. It costs tens of times what all else costs, so on a large plant
/// loops that give no cause take turns.
struct ModelPolicy {
  /// nullopt: a model whatever the statistics say. Else only where they give this cause.
  std::optional<core::ModelTrigger> cause;
};

/// The wish for one slot of a claimed loop. Whatever the statistics say: where the plant is small
/// enough, where the loop's last verdict was a fault (so that a finding of the model stands or
/// falls by the model again) or nothing could be said, and where it is the loop's turn. The same
/// slot has the same turn whenever it is done.
[[nodiscard]] ModelPolicy model_wish(const config::Settings& settings, std::size_t enabled_loops,
                                     const storage::ClaimedLoop& claim, std::int64_t slot_end_us);

/// Analyses one loop's input and adds the provenance that is stored with it, and what each stage
/// took, by `driver`. `settings_json` names the settings in force; it is part of the digest, so
/// that changed settings make a revision. A model is fitted where the settings allow one and `wish`
/// asks for it.
[[nodiscard]] storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop,
                                                     const LoopInput& input,
                                                     const core::AnalysisSettings& settings,
                                                     const std::string& settings_json,
                                                     StageDriver& driver,
                                                     const ModelPolicy& wish = {});

/// The digest that the record of this input carries: over the window and, where one was read, over
/// the longer span.
[[nodiscard]] std::string digest_of(const storage::CatalogueEntry& loop, const LoopInput& input,
                                    const std::string& settings_json);

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

/// How loops are to be analysed.
struct AnalysisOrders {
  const config::Settings& settings;
  const std::string& settings_json;  ///< those of the analysis: provenance and part of the digest
  std::size_t enabled_loops = 0;     ///< in the catalogue: decides whether models take turns
};

/// Analyses every slot of the task whose digest is not the stored one and says what to write.
/// Throws what core/ throws.
[[nodiscard]] storage::CompletedLoop complete_task(const LoopTask& task,
                                                   const StoredAnalyses& stored,
                                                   const AnalysisOrders& orders,
                                                   StageDriver& driver);

/// Keeps the error of the newest slot.
void keep_error(const LoopTask& task, KeptErrors& errors);

}  // namespace loopscope::daemon
