#include "daemon/replay/repeat_analysis.hpp"

#include <fmt/format.h>

#include "config/analysis_settings_json.hpp"
#include "daemon/service/batches/loop_task.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

LoopInput read_stored(const config::Settings& settings, const storage::StoredAnalysis& stored,
                      const core::AnalysisSettings& analysis) {
  const config::HistorianSettings& source = find_historian(settings, stored.loop.source);
  storage::HistorianReader historian(historian_connection(source), historian_layout(source));
  LoopSlot slot = past_slot(stored.loop, stored.slot_end_us);
  slot.pv_past = stored.pv_past;
  return read_input(historian, slot, analysis);
}

}  // namespace

storage::AnalysisRecord repeat_analysis(const config::Settings& settings,
                                        const storage::StoredAnalysis& stored) {
  core::AnalysisSettings analysis = config::parse_analysis_settings(stored.settings_json);
  const std::string words = config::analysis_settings_json(analysis);
  const LoopInput input = read_stored(settings, stored, analysis);
  if (input.at_slot.window.size() == 0) {
    throw Failure(ExitCode::unusable_data,
                  fmt::format("the historian {} has no row of {} in that window any more",
                              stored.loop.source, stored.loop.pv_tag),
                  "only what the historian still keeps can be done again");
  }
  analysis.fit_model = stored.modelled;
  StageDriver driver;
  return analyse_window(stored.loop, input, analysis, words, driver);
}

}  // namespace loopscope::daemon
