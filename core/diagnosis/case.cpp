#include "core/diagnosis/case.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Where creeps() draws its line: healthy_flow has 0.85, paper_5_1 0.75, paper_5_2_printed 0.65,
/// sluggish_tuning 0.32.
constexpr double kSluggishHarris = 0.45;

/// Paper, section 6.2.1: op between 49.4 and 50 % while pv swings.
constexpr double kTinyOpSpanPercent = 2.0;
constexpr double kLargePvShare = 0.05;
/// An oscillation that carries less than this share of the error's variance is not what makes the
/// loop perform poorly: those found by chance carry 0.03 to 0.14 (paper_5_1, healthy_flow), real
/// ones 0.24 and more (paper_5_3, where the load wanders; tight_tuning has 0.88).
constexpr double kOscillationShare = 0.2;
/// An oscillation whose autocorrelation keeps this share over three further periods is driven by
/// a line; a loop at the edge of stability under noise keeps 0.6 to 0.75 (tight_tuning and
/// paper_5_2_excessive), an outside sinusoid 0.95 and more (outside_oscillation, paper_5_3).
constexpr double kSustained = 0.85;

std::string oscillation_text(const loop::Oscillation& oscillation) {
  return "Oscillation of period " + duration(oscillation.period_s.value_or(0.0)) + ", regularity " +
         number(oscillation.regularity.value_or(0.0)) + ", persistence " +
         number(oscillation.persistence.value_or(0.0)) + ".";
}

}  // namespace

bool has_flag(const Evidence& evidence, std::string_view flag) {
  const auto& flags = evidence.data_quality.flags;
  return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

bool op_speaks(const Evidence& evidence) {
  return !has_flag(evidence, "op_constant") && !has_flag(evidence, "op_missing");
}

bool oscillates(const Evidence& evidence) {
  const double amplitude = evidence.oscillation.amplitude.value_or(0.0);
  const double error_std = evidence.performance.error_std.value_or(0.0);
  return evidence.oscillation.present &&
         0.5 * amplitude * amplitude >= kOscillationShare * error_std * error_std;
}

bool oversized(const Evidence& evidence) {
  const loop::ValveGain& gain = evidence.valve_gain;
  return gain.op_span_percent.value_or(100.0) < kTinyOpSpanPercent &&
         gain.pv_relative_span.value_or(0.0) > kLargePvShare;
}

std::string oversized_text(const loop::ValveGain& gain) {
  return "op spans " + number(*gain.op_span_percent) + " %, pv " + percent(*gain.pv_relative_span) +
         " of its level.";
}

std::optional<double> middle_harris(const Evidence& evidence) {
  const loop::Performance& performance = evidence.performance;
  if (evidence.integrating || !performance.harris_low || !performance.harris_high) {
    return std::nullopt;
  }
  return std::sqrt(*performance.harris_low * *performance.harris_high);
}

bool creeps(const Evidence& evidence) {
  return middle_harris(evidence).value_or(1.0) < kSluggishHarris;
}

double creeping_confidence(const Evidence& evidence) {
  constexpr double kAtTheLine = 0.1;
  constexpr double kByIndex = 0.4;
  return kAtTheLine + kByIndex * (kSluggishHarris - middle_harris(evidence).value());
}

std::string harris_text(const Evidence& evidence) {
  return "Harris index " + number(*evidence.performance.harris_low) + " to " +
         number(*evidence.performance.harris_high) + " over the plausible delays (1 is the best).";
}

bool sustained(const Evidence& evidence) {
  return evidence.oscillation.persistence.value_or(0.0) >= kSustained;
}

std::string quantisation_text(const Evidence& evidence) {
  return "pv moves in steps of " + number(evidence.data_quality.quantisation_factor.value_or(0.0)) +
         " of its standard deviation.";
}

bool coupling_leads(const Case& loop) {
  constexpr double kWeak = 1e-3;
  const double p = loop.nonlinearity.p;
  if (!loop.nonlinearity.found) return false;
  return p <= kWeak || p <= oscillation_p(loop.evidence).value_or(1.0);
}

std::vector<std::string> reasons_of(const Case& loop) {
  std::vector<std::string> reasons{loop.nonlinearity.reason};
  if (oscillates(loop.evidence)) {
    reasons.push_back(oscillation_text(loop.evidence.oscillation));
  }
  reasons.insert(reasons.end(), loop.valve.reasons.begin(), loop.valve.reasons.end());
  return reasons;
}

std::vector<std::string> with(std::vector<std::string> reasons, std::string reason) {
  reasons.push_back(std::move(reason));
  return reasons;
}

Verdict make(VerdictCode code, double confidence, std::vector<std::string> reasons,
             std::optional<double> p) {
  return {code,
          std::clamp(confidence, 0.0, 1.0),
          summary_of(code),
          std::move(reasons),
          action_for(code),
          p};
}

std::optional<double> oscillation_p(const Evidence& evidence) {
  return oscillates(evidence) ? evidence.oscillation.p : std::nullopt;
}

double coupling_or_oscillation_p(const Case& loop) {
  return std::min(loop.nonlinearity.p, oscillation_p(loop.evidence).value_or(1.0));
}

Verdict oversized_valve(const Case& loop, std::optional<double> p) {
  return make(VerdictCode::valve_oversized, 0.5,
              with(reasons_of(loop), oversized_text(loop.evidence.valve_gain)), p);
}

}  // namespace loopscope::core::diagnosis
