#include "daemon/recording/analyse_recording.hpp"

#include "core/signal/grid.hpp"
#include "core/signal/stand_still.hpp"
#include "core/signal/window_digest.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopWindow;

nlohmann::ordered_json time_json(std::int64_t time_us, bool absolute) {
  constexpr double kSecondsPerMicrosecond = 1e-6;
  if (absolute) return format_time(time_us);
  return static_cast<double>(time_us) * kSecondsPerMicrosecond;
}

InputFacts facts_of(const Recording& recording, const LoopWindow& window) {
  InputFacts facts{recording.name, window.size(), std::nullopt, nullptr, nullptr};
  if (window.size() == 0) return facts;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  if (window.size() > 1) facts.interval_s = window.sample_interval_s;
  facts.start = time_json(grid.start_us, recording.absolute_time);
  facts.end = time_json(grid.time_us(window.size() - 1), recording.absolute_time);
  return facts;
}

/// What the recording tells of pv from before the window.
std::optional<core::signal::PvPast> past_of(const Recording& recording,
                                            const core::AnalysisSettings& settings,
                                            const LoopWindow& window) {
  if (window.size() == 0) return std::nullopt;
  constexpr std::size_t kMostPastWindows = 16;
  const LoopWindow before =
      last_window(recording, kMostPastWindows * settings.prepare.window_samples, window.op_range,
                  window.start_us - 1);
  if (before.size() == 0) return std::nullopt;
  return core::signal::past_with(
      {.pv = before.pv, .mode = before.mode, .sample_interval_s = before.sample_interval_s});
}

}  // namespace

RecordingAnalysis analyse_recording(const Recording& recording,
                                    const core::AnalysisSettings& settings,
                                    const std::optional<core::signal::OpRange>& op_range,
                                    core::LoopFacts facts, std::optional<std::int64_t> end_us) {
  RecordingAnalysis analysis;
  analysis.window = last_window(recording, settings.prepare.window_samples, op_range, end_us);
  analysis.window.pv_past = past_of(recording, settings, analysis.window);
  analysis.input = facts_of(recording, analysis.window);
  const core::FirstLook first = core::first_look(analysis.window, settings);
  std::optional<LoopWindow> longer;
  if (first.slow_span_samples > 0) {
    longer = last_window(recording, first.slow_span_samples, op_range, end_us);
  }
  facts.seed = core::signal::window_seed(analysis.window);
  analysis.diagnosis = core::diagnose(first, settings, facts, longer ? &*longer : nullptr);
  return analysis;
}

}  // namespace loopscope::daemon
