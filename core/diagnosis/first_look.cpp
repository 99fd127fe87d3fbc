#include "core/diagnosis/first_look.hpp"

#include <algorithm>

#include "core/hos/slow_look.hpp"
#include "core/signal/prepare.hpp"

namespace loopscope::core {
namespace {

/// The span that the slow look wants, as far as the settings allow, if it is longer than a window.
std::size_t wanted_span(const FirstLook& first, const AnalysisSettings& settings) {
  const signal::PrepareSettings& prepare = settings.prepare;
  const std::optional<double> period = first.period_samples();
  const std::size_t most = prepare.slow_span_windows * prepare.window_samples;
  const std::size_t wanted =
      period ? std::min(hos::slow_span(*period, settings.hos), most) : std::size_t{0};
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
  if (!first.loop.quality.usable) return first;
  first.oscillation =
      loop::find_oscillation(first.loop.error, window.sample_interval_s, settings.oscillation);
  first.slow_span_samples = wanted_span(first, settings);
  return first;
}

}  // namespace loopscope::core
