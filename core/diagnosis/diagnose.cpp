#include "core/diagnosis/diagnose.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/diagnosis/decide.hpp"
#include "core/hos/segments.hpp"
#include "core/signal/setpoint_steps.hpp"
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

void add_once(std::vector<std::string>& flags, const char* flag) {
  if (std::ranges::find(flags, flag) == flags.end()) flags.emplace_back(flag);
}

/// The error without the transients of setpoint steps, where enough segments are left without them;
/// else the whole error, and the flag of a setpoint that moves too often.
signal::Samples steady_error(const signal::PreparedLoop& loop, const AnalysisSettings& settings,
                             signal::DataQuality& quality) {
  const signal::ErrorBetweenSteps between = signal::error_between_steps(loop);
  if (between.steps == 0) return loop.error;
  const bool enough = hos::segment_starts(between.error, settings.hos).size() >= kMinSegments;
  const bool masked = enough && between.masked_fraction > 0.0;
  add_once(quality.flags, masked ? "sp_steps_masked" : "sp_moving");
  return masked ? between.error : loop.error;
}

void measure_statistics(const signal::PreparedLoop& loop, const AnalysisSettings& settings,
                        Evidence& evidence) {
  evidence.hos = hos::analyse(steady_error(loop, settings, evidence.data_quality), settings.hos);
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

void measure_shapes(const signal::PreparedLoop& loop, const AnalysisSettings& settings,
                    Evidence& evidence) {
  evidence.oscillation =
      loop::find_oscillation(loop.error, loop.sample_interval_s, settings.oscillation);
  loop::ShapeInput input{loop.error,      loop.pv,      loop.op_percent,
                         loop.mv_percent, std::nullopt, evidence.integrating};
  if (evidence.oscillation.present && evidence.oscillation.period_s) {
    input.period_samples = *evidence.oscillation.period_s / loop.sample_interval_s;
  }
  evidence.shape = loop::measure_shape(input);
  evidence.valve_gain = loop::measure_valve_gain(loop.pv, loop.op_percent);
}

}  // namespace

Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                   const LoopFacts& facts) {
  const signal::PreparedLoop loop = signal::prepare(window, settings.prepare);
  Diagnosis diagnosis;
  Evidence& evidence = diagnosis.evidence;
  evidence.data_quality = loop.quality;
  evidence.integrating = facts.integrating;
  evidence.performance =
      loop::measure_performance(loop.error, loop.op_percent, loop.mode, loop.sample_interval_s,
                                loop.op_range_known, settings.performance);
  if (evidence.data_quality.usable) {
    measure_statistics(loop, settings, evidence);
    measure_shapes(loop, settings, evidence);
  }
  diagnosis.verdict = diagnosis::decide(evidence, settings.hos);
  return diagnosis;
}

}  // namespace loopscope::core
