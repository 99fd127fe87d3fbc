#include "core/diagnosis/diagnose.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/diagnosis/decide.hpp"
#include "core/signal/spread.hpp"

namespace loopscope::core {
namespace {

/// Fewer segments than 512 samples give (15) average too little to judge.
constexpr std::size_t kMinSegments = 15;
/// Findings on fewer carry the flag `short`.
constexpr std::size_t kShortSegments = 32;

std::string unusable_segments(std::size_t segments, const signal::PreparedLoop& loop) {
  const auto spread = signal::measure_spread(loop.error);
  if (spread && spread->constant()) return "the error does not vary";
  return "the gaps leave " + std::to_string(segments) + " unbroken segments, at least " +
         std::to_string(kMinSegments) + " are needed";
}

void measure_statistics(const signal::PreparedLoop& loop, const AnalysisSettings& settings,
                        Evidence& evidence) {
  evidence.hos = hos::analyse(loop.error, settings.hos);
  signal::DataQuality& quality = evidence.data_quality;
  const std::size_t segments = evidence.hos ? evidence.hos->segments : 0;
  if (segments < kMinSegments) {
    evidence.hos.reset();
    quality.usable = false;
    quality.reason = unusable_segments(segments, loop);
  } else if (segments < kShortSegments) {
    quality.flags.emplace_back("short");
  }
}

/// Period of the oscillation in samples; nullopt when none is present.
std::optional<double> period_samples(const loop::Oscillation& oscillation, double interval_s) {
  if (!oscillation.present || !oscillation.period_s) return std::nullopt;
  return *oscillation.period_s / interval_s;
}

/// The span that the slow look wants, as far as the settings allow, if it is longer than a window.
std::size_t wanted_span(const FirstLook& first, const AnalysisSettings& settings) {
  const signal::PrepareSettings& prepare = settings.prepare;
  const auto period = period_samples(first.oscillation, first.loop.sample_interval_s);
  const std::size_t most = prepare.slow_span_windows * prepare.window_samples;
  const std::size_t wanted =
      period ? std::min(hos::slow_span(*period, settings.hos), most) : std::size_t{0};
  return wanted > prepare.window_samples ? wanted : 0;
}

void measure_shapes(const FirstLook& first, Evidence& evidence) {
  const signal::PreparedLoop& loop = first.loop;
  evidence.shape = loop::measure_shape({loop.error, loop.pv, loop.op_percent, loop.mv_percent,
                                        period_samples(first.oscillation, loop.sample_interval_s),
                                        evidence.integrating});
  evidence.valve_gain = loop::measure_valve_gain(loop.pv, loop.op_percent);
}

signal::Samples long_error(const signal::LoopWindow& window, double interval_s,
                           const AnalysisSettings& settings) {
  if (window.sample_interval_s != interval_s) {
    throw std::invalid_argument("the long window has another sample interval than the window");
  }
  signal::PrepareSettings prepare = settings.prepare;
  prepare.window_samples = window.size();
  return signal::prepare(window, prepare).error;
}

void look_slowly(const FirstLook& first, const AnalysisSettings& settings,
                 const signal::LoopWindow* long_window, Evidence& evidence) {
  const double interval_s = first.loop.sample_interval_s;
  const auto period = period_samples(first.oscillation, interval_s);
  if (!period || !hos::needs_slow_look(*period, settings.hos)) return;
  evidence.hos_slow = hos::look_slowly(
      long_window ? long_error(*long_window, interval_s, settings) : first.loop.error, *period,
      settings.hos);
}

}  // namespace

FirstLook first_look(const signal::LoopWindow& window, const AnalysisSettings& settings) {
  FirstLook first;
  first.loop = signal::prepare(window, settings.prepare);
  if (!first.loop.quality.usable) return first;
  first.oscillation =
      loop::find_oscillation(first.loop.error, window.sample_interval_s, settings.oscillation);
  first.slow_span_samples = wanted_span(first, settings);
  return first;
}

Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                   const LoopFacts& facts, const signal::LoopWindow* long_window) {
  return diagnose(first_look(window, settings), settings, facts, long_window);
}

Diagnosis diagnose(const FirstLook& first, const AnalysisSettings& settings, const LoopFacts& facts,
                   const signal::LoopWindow* long_window) {
  const signal::PreparedLoop& loop = first.loop;
  Diagnosis diagnosis;
  Evidence& evidence = diagnosis.evidence;
  evidence.data_quality = loop.quality;
  evidence.integrating = facts.integrating;
  evidence.oscillation = first.oscillation;
  evidence.slow_span_samples = first.slow_span_samples;
  evidence.performance =
      loop::measure_performance(loop.error, loop.op_percent, loop.mode, loop.sample_interval_s,
                                loop.op_range_known, settings.performance);
  if (evidence.data_quality.usable) {
    measure_statistics(loop, settings, evidence);
    measure_shapes(first, evidence);
    if (evidence.hos) look_slowly(first, settings, long_window, evidence);
  }
  diagnosis.verdict = diagnosis::decide(evidence, settings.hos);
  return diagnosis;
}

}  // namespace loopscope::core
