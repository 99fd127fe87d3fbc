#include "daemon/recording/analyse_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/diagnosis/decide.hpp"
#include "core/signal/grid.hpp"

namespace loopscope::daemon {
namespace {

namespace diagnosis = core::diagnosis;
using core::signal::LoopWindow;

constexpr std::size_t kMostWindows = 8;
constexpr double kMicrosecondsPerSecond = 1e6;

/// Ends of the windows before the last one, the oldest first.
std::vector<std::int64_t> earlier_ends(const LoopWindow& whole, std::size_t window) {
  std::vector<std::int64_t> ends;
  if (whole.size() <= window) return ends;
  const auto beyond = static_cast<double>(whole.size() - window);
  const double parts = std::ceil(beyond / static_cast<double>(window));
  const double step_us = beyond / parts * whole.sample_interval_s * kMicrosecondsPerSecond;
  const core::signal::Grid grid{whole.start_us, whole.sample_interval_s, whole.size()};
  const std::int64_t last_us = grid.time_us(whole.size() - 1);
  const std::size_t count = std::min(kMostWindows - 1, static_cast<std::size_t>(parts));
  for (std::size_t back = count; back >= 1; --back)
    ends.push_back(core::signal::moved_us(last_us, -static_cast<double>(back) * step_us));
  return ends;
}

diagnosis::JudgedWindow judged(const RecordingAnalysis& analysis) {
  const LoopWindow& window = analysis.window;
  const double start_s = static_cast<double>(window.start_us) / kMicrosecondsPerSecond;
  const double length_s = static_cast<double>(window.size()) * window.sample_interval_s;
  return {start_s, start_s + length_s, analysis.diagnosis.evidence.model.has_value(),
          diagnosis::evidence_of(analysis.diagnosis.verdict)};
}

/// Windows that could not be judged say nothing.
void add_to_odds(const RecordingAnalysis& analysis,
                 std::optional<diagnosis::CombinedOdds>& combined, std::size_t& count) {
  const diagnosis::JudgedWindow window = judged(analysis);
  if (window.evidence.empty()) return;
  combined = diagnosis::combine(combined, window);
  ++count;
}

}  // namespace

WindowsAnalysis analyse_windows(const Recording& recording, const core::AnalysisSettings& settings,
                                const std::optional<core::signal::OpRange>& op_range,
                                const core::LoopFacts& facts) {
  const LoopWindow whole =
      last_window(recording, kMostWindows * settings.prepare.window_samples, op_range);
  std::optional<diagnosis::CombinedOdds> combined;
  std::size_t count = 0;
  for (const std::int64_t end_us : earlier_ends(whole, settings.prepare.window_samples))
    add_to_odds(analyse_recording(recording, settings, op_range, facts, end_us), combined, count);
  WindowsAnalysis result{analyse_recording(recording, settings, op_range, facts)};
  core::Diagnosis& newest = result.newest.diagnosis;
  const std::size_t before = count;
  add_to_odds(result.newest, combined, count);
  // With nothing before it, or nothing of its own, the newest window's verdict stands.
  if (before == 0 || count == before) return result;
  result.judged = count;
  result.together = diagnosis::most_windows(*combined);
  result.newest_alone = std::move(newest.verdict);
  newest.verdict = diagnosis::decide(newest.evidence, settings.hos, settings.decision, &*combined);
  return result;
}

}  // namespace loopscope::daemon
