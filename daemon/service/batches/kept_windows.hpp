#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/batches/loop_task.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/service/windows/window_cache.hpp"

namespace loopscope::daemon {

/// What a batch has from the window cache and leaves in it. Rows of a loop's last slot that are
/// kept are not read again, but for those of the `revise_slots` periods before its end (none: of
/// its last sample): what came late there is noticed at once, as without the cache. What changed
/// further back is noticed when the window is read whole: at every `whole_read_every`-th slot at
/// the latest, and whenever the stored analysis of the last slot is not that of the rows that are
/// kept.
class KeptWindows {
 public:
  /// Both have to outlive this.
  KeptWindows(WindowCache& cache, std::shared_ptr<const config::Settings> settings,
              const std::string& settings_json)
      : cache_(&cache), settings_(std::move(settings)), settings_json_(&settings_json) {}

  /// Puts into `memory` what may be used for these slots.
  void use(std::span<const storage::ClaimedLoop* const> claims, std::span<const LoopSlot> slots,
           const StoredAnalyses& stored, RowMemory& memory);
  /// Sees, after the newest windows were read, for which loops the rows that were read again are
  /// those that were kept.
  void compare(const RowMemory& memory);
  /// Whether the stored analysis of an earlier slot is known to be that of the rows as they are.
  [[nodiscard]] bool still_holds(const storage::ClaimedLoop& claim, std::int64_t slot_end_us,
                                 const StoredAnalyses& stored) const;
  /// Whether rows of a batch are of no use once its windows are made.
  [[nodiscard]] bool keep_nothing() const;
  /// Keeps the rows of a loop that was analysed, if that is of use.
  void keep(const LoopTask& task, const storage::CompletedLoop& completed,
            const StoredAnalyses& stored, const RowMemory& memory) const;

 private:
  struct Use {
    std::shared_ptr<const KeptWindow> window;
    std::int64_t fresh_from_us = 0;  ///< rows from then on are read again
    std::vector<KnownRows> tags;     ///< all that is kept, in the order of the window's tags
    bool unchanged = false;          ///< what was read again is what is kept
  };
  [[nodiscard]] std::optional<Use> use_of(const storage::ClaimedLoop& claim, const LoopSlot& slot,
                                          const StoredAnalyses& stored) const;
  void drop_contradictory();
  [[nodiscard]] bool is_of(const KeptWindow& window, const storage::ClaimedLoop& claim,
                           const StoredAnalyses& stored) const;
  [[nodiscard]] bool is_to_be_read_whole(const KeptWindow& window,
                                         const storage::CatalogueEntry& loop,
                                         std::int64_t slot_end_us) const;
  [[nodiscard]] std::optional<KeptWindow> window_of(const LoopTask& task,
                                                    const storage::CompletedLoop& completed,
                                                    const StoredAnalyses& stored,
                                                    const RowMemory& memory) const;
  [[nodiscard]] std::size_t facts_of(const storage::CatalogueEntry& loop) const;
  [[nodiscard]] std::int64_t read_again_us(const KeptWindow& window,
                                           const storage::CatalogueEntry& loop) const;
  [[nodiscard]] std::map<std::int64_t, std::string> digests_of(
      const LoopTask& task, const storage::CompletedLoop& completed,
      const StoredAnalyses& stored) const;

  WindowCache* cache_;
  std::shared_ptr<const config::Settings> settings_;
  const std::string* settings_json_;
  std::map<std::int64_t, Use> uses_;  ///< by loop
};

}  // namespace loopscope::daemon
