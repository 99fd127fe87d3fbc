#include "core/diagnosis/first_look.hpp"

#include <algorithm>

#include "core/hos/slow_look.hpp"
#include "core/signal/prepare.hpp"

namespace loopscope::core {
namespace {

/// The span that the slow look wants, as far as the settings allow, if it is longer than a window;
/// and all of it where pv stands still in the whole window and nothing is known from before: a calm
/// loop in a coarse archive stood as long before.
std::size_t wanted_span(const FirstLook& first, const signal::LoopWindow& window,
                        const AnalysisSettings& settings) {
  const signal::PrepareSettings& prepare = settings.prepare;
  if (!first.loop.control.controlling()) return 0;
  const std::optional<double> period = first.period_samples();
  const std::size_t most = prepare.slow_span_windows * prepare.window_samples;
  const bool unknown = first.loop.still && first.loop.still->whole && !window.pv_past;
  const std::size_t slow =
      period ? std::min(hos::slow_span(*period, settings.hos), most) : std::size_t{0};
  const std::size_t wanted = unknown ? most : slow;
  return wanted > prepare.window_samples ? wanted : 0;
}

}  // namespace

std::optional<double> FirstLook::period_samples() const {
  if (!oscillation.present || !oscillation.period_s) return std::nullopt;
  return *oscillation.period_s / loop.sample_interval_s;
}

FirstLook first_look(const signal::LoopWindow& window, const AnalysisSettings& settings) {
  FirstLook first;
  first.loop = signal::prepare(window, settings.prepare);
  if (first.loop.quality.usable)
    first.oscillation =
        loop::find_oscillation(first.loop.error, window.sample_interval_s, settings.oscillation);
  first.slow_span_samples = wanted_span(first, window, settings);
  return first;
}

}  // namespace loopscope::core
