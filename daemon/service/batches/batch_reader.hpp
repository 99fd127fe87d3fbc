#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/batches/batch.hpp"
#include "daemon/service/observe/stage_driver.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "daemon/service/windows/slot.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// A historian's time, and how the ends of its slots are found.
struct SourceTime {
  std::int64_t now_us = 0;
  SlotRule rule = SlotRule::clock;
};

/// Brings a batch from its claims to windows that are ready for analysis: the newest of each loop,
/// what is stored of their slots, and the earlier ones that late rows may have changed; of claims
/// for slots of the past their windows alone. Rows that are kept from the last visit are not read
/// again (KeptWindows); those of the batch stay in it. Rows are
/// read with a connection to the historian, windows prepared with a core, nothing with both. What
/// is done when that fails is decided here: a source that is away postpones its loops, a loop at
/// fault is set aside.
class BatchReader {
 public:
  enum class Read {
    all,
    nothing,  ///< the loops stand in Batch::failed
    apart,    ///< one of the loops is at fault: to be tried one by one
  };

  /// `settings_json` is the provenance of every analysis. What is passed has to outlive this.
  BatchReader(std::shared_ptr<const config::Settings> settings, const std::string& settings_json,
              SlotRule slot_rule, SharedServices& tools, ProgressBoard::Entry& progress,
              ResultsLink& results, StageDriver& driver);

  /// Throws storage::DatabaseError when the results database fails.
  [[nodiscard]] Read read(const std::string& source, const Claims& claims, Batch& batch);

 private:
  /// Runs `use` on a connection to the source.
  template <typename Use>
  Read with_source(const std::string& source, const Claims& claims, Batch& batch, Use use);
  [[nodiscard]] SourceTime time_of(const std::string& source, storage::HistorianReader& historian);
  Read read_newest(const std::string& source, const Claims& claims, Batch& batch);
  Read read_earlier(const std::string& source, const Claims& claims, Batch& batch);
  /// Longer spans of those inputs that ask for them.
  Read read_longer(const std::string& source, const Claims& claims, Batch& batch,
                   std::span<const InputOfLoop> inputs);
  [[nodiscard]] std::vector<LoopSlot> slots_of(const Claims& claims, const SourceTime& time,
                                               storage::HistorianReader& historian) const;
  [[nodiscard]] std::vector<LoopWindowAtSlot> windows_of(storage::HistorianReader& historian,
                                                         std::span<const LoopSlot> slots,
                                                         Batch& batch);
  /// Calls `keep(claim, input)` for each window, `of_windows` says whose each is.
  template <typename Keep>
  void prepare(const Claims& of_windows, std::vector<LoopWindowAtSlot> windows, Batch& batch,
               Keep keep);
  [[nodiscard]] StoredAnalyses stored_analyses(const Claims& claims,
                                               std::span<const LoopSlot> slots);
  void source_is_away(const std::string& source, const Failure& failure, const Claims& claims,
                      Batch& batch);

  std::shared_ptr<const config::Settings> settings_;
  const std::string& settings_json_;
  SlotRule slot_rule_;
  SharedServices& tools_;
  ProgressBoard::Entry& progress_;
  ResultsLink& results_;
  StageDriver& driver_;
};

}  // namespace loopscope::daemon
