#include "daemon/service/analyse_window.hpp"

#include <chrono>

#include "core/hos/triple_sums.hpp"
#include "core/signal/grid.hpp"
#include "core/signal/window_digest.hpp"
#include "daemon/commands/option_values.hpp"

namespace loopscope::daemon {

std::string digest_of(const storage::CatalogueEntry& loop, const LoopWindowAtSlot& at_slot,
                      const std::string& settings_json) {
  return core::signal::window_digest(at_slot.window, settings_json + loop.loop_type);
}

storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop,
                                       const LoopWindowAtSlot& at_slot,
                                       const core::AnalysisSettings& settings,
                                       const std::string& settings_json) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const core::signal::LoopWindow& window = at_slot.window;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  storage::AnalysisRecord record;
  record.slot_end_us = at_slot.slot_end_us;
  record.window_start_us = window.size() > 0 ? grid.start_us : at_slot.slot_end_us;
  record.window_end_us = window.size() > 0 ? grid.time_us(window.size() - 1) : at_slot.slot_end_us;
  record.samples = window.size();
  record.sample_interval_s = window.size() > 1 ? window.sample_interval_s : 0.0;
  record.input_digest = digest_of(loop, at_slot, settings_json);
  // Verdicts are reproducible to the last digit on one processor path only.
  record.program_version =
      std::string(LOOPSCOPE_VERSION " ") + std::string(core::hos::processor_path());
  record.settings_json = settings_json;
  const auto start = std::chrono::steady_clock::now();
  record.diagnosis =
      core::diagnose(window, settings, {.integrating = is_integrating_type(loop.loop_type)});
  record.analyse_ms = Milliseconds(std::chrono::steady_clock::now() - start).count();
  return record;
}

}  // namespace loopscope::daemon
