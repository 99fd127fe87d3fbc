#include "core/diagnosis/decide.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/nonlinearity.hpp"
#include "core/diagnosis/valve_pattern.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

/// op at a limit for more of the window than this is a finding of its own (notes on 141 loops).
constexpr double kSaturatedFraction = 0.05;
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
/// A line from outside is a sinusoid once the loop has filtered it; a sustained oscillation of no
/// clear shape may as well be a limit cycle of the loop's own valve and is believed less.
constexpr double kSinusoidal = 0.4;
constexpr double kUnclearShape = 0.6;
/// Without support from the bispectrum the shapes alone have to speak more clearly.
constexpr double kClearShapes = 0.75;
/// NGI in multiples of its limit at which the published rule is believed in full. White and AR(1)
/// noise pass the limit itself in 3 to 8 % of the records, 2.4 times the limit in at most 0.3 % (a
/// random walk in 2.6 %), four times it never in 4000 (0.4 %).
constexpr double kConvincingStrength = 4.0;
/// Geometric middle of the Harris range below which a loop is called slow: healthy_flow has 0.85,
/// paper_5_1 0.75, paper_5_2_printed 0.65, sluggish_tuning 0.32.
constexpr double kSluggishHarris = 0.45;
/// Findings on fewer than 32 segments weigh less.
constexpr double kShortRecord = 0.75;

/// Evidence with what follows from it, as the branches of the flow read it.
struct Case {
  const Evidence& evidence;
  NonlinearityFinding nonlinearity;
  ValvePattern valve;
};

bool has_flag(const Evidence& evidence, std::string_view flag) {
  const auto& flags = evidence.data_quality.flags;
  return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

/// op was recorded and moves: without that nothing is claimed of controller and valve.
bool op_speaks(const Evidence& evidence) {
  return !has_flag(evidence, "op_constant") && !has_flag(evidence, "op_missing");
}

Verdict make(VerdictCode code, double confidence, std::vector<std::string> reasons) {
  return {code, std::clamp(confidence, 0.0, 1.0), summary_of(code), std::move(reasons),
          action_for(code)};
}

bool oscillates(const Evidence& evidence) {
  const double amplitude = evidence.oscillation.amplitude.value_or(0.0);
  const double error_std = evidence.performance.error_std.value_or(0.0);
  return evidence.oscillation.present &&
         0.5 * amplitude * amplitude >= kOscillationShare * error_std * error_std;
}

std::string oscillation_text(const loop::Oscillation& oscillation) {
  return "Oscillation of period " + duration(oscillation.period_s.value_or(0.0)) + ", regularity " +
         number(oscillation.regularity.value_or(0.0)) + ", persistence " +
         number(oscillation.persistence.value_or(0.0)) + ".";
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

bool oversized(const loop::ValveGain& gain) {
  return gain.op_span_percent.value_or(100.0) < kTinyOpSpanPercent &&
         gain.pv_relative_span.value_or(0.0) > kLargePvShare;
}

std::string quantisation_text(const Evidence& evidence) {
  return "pv moves in steps of " + number(evidence.data_quality.quantisation_factor.value_or(0.0)) +
         " of its standard deviation.";
}

std::string oversized_text(const loop::ValveGain& gain) {
  return "op spans " + number(*gain.op_span_percent) + " %, pv " + percent(*gain.pv_relative_span) +
         " of its level.";
}

Verdict oversized_valve(const Case& loop) {
  return make(VerdictCode::valve_oversized, 0.5,
              with(reasons_of(loop), oversized_text(loop.evidence.valve_gain)));
}

Verdict saturated(const Evidence& evidence) {
  const double fraction = *evidence.data_quality.saturated_fraction;
  return make(VerdictCode::valve_saturation, 0.5 + 0.4 * std::min(1.0, fraction / 0.5),
              {"op is at a limit of its range in " + percent(fraction) + " of the samples."});
}

/// The valve position was recorded: what it shows is measured, whatever the bispectrum says.
Verdict faulty_position(const Case& loop) {
  const bool sticks = loop.valve.kind == Kind::sticks;
  return make(sticks ? VerdictCode::valve_stiction : VerdictCode::valve_deadband, 0.9,
              reasons_of(loop));
}

/// How far the published rule is believed, 0 to 1: skewed noise passes it too, but without a
/// bifrequency that stands out.
double belief_in(const Case& loop) {
  const double strength = std::min(1.0, loop.nonlinearity.strength / kConvincingStrength);
  return loop.evidence.hos->peaks.empty() ? 0.5 * strength : strength;
}

Verdict nonlinear(const Case& loop) {
  const double belief = belief_in(loop);
  if (!op_speaks(loop.evidence)) {
    return make(VerdictCode::nonlinear_unexplained, 0.4 * belief,
                with(reasons_of(loop),
                     "op does not move: the loop itself says nothing about its "
                     "valve; the cause may lie outside."));
  }
  if (oversized(loop.evidence.valve_gain)) return oversized_valve(loop);
  if (loop.valve.kind == Kind::sticks) {
    return make(VerdictCode::valve_stiction, 0.3 + 0.3 * loop.valve.score + 0.2 * belief,
                reasons_of(loop));
  }
  if (loop.valve.kind == Kind::follows) {
    // A step of the load or a changed gain looks the same without a model of the loop.
    return make(VerdictCode::process_nonlinearity, 0.4 * belief,
                with(reasons_of(loop),
                     "The valve follows its signal: the cause lies in the process "
                     "or in what disturbs it."));
  }
  return make(VerdictCode::nonlinear_unexplained, 0.5 * belief, reasons_of(loop));
}

/// An oscillation of a loop whose output says nothing: one that stands still cannot make it, one
/// that was not recorded may.
Verdict oscillating_without_op(const Case& loop) {
  if (has_flag(loop.evidence, "op_missing")) {
    return make(VerdictCode::unexplained, 0.4,
                with(reasons_of(loop),
                     "op is not recorded: whether the controller makes the "
                     "oscillation cannot be told."));
  }
  return make(VerdictCode::external_disturbance, 0.5,
              with(reasons_of(loop), "op does not move, so the controller does not make it."));
}

Verdict linear_oscillating(const Case& loop) {
  if (!op_speaks(loop.evidence)) return oscillating_without_op(loop);
  if (oversized(loop.evidence.valve_gain)) return oversized_valve(loop);
  if (loop.valve.kind == Kind::sticks && loop.valve.score >= kClearShapes) {
    return make(VerdictCode::valve_stiction, 0.3 + 0.3 * loop.valve.score,
                with(reasons_of(loop),
                     "A symmetric limit cycle carries odd harmonics only, to "
                     "which the bispectrum is blind: the shapes decide."));
  }
  const double persistence = loop.evidence.oscillation.persistence.value_or(0.0);
  if (persistence >= kSustained) {
    const bool sinusoidal = loop.evidence.shape.shape_index.value_or(1.0) <= kSinusoidal;
    return make(VerdictCode::external_disturbance,
                (0.3 + 0.3 * persistence) * (sinusoidal ? 1.0 : kUnclearShape), reasons_of(loop));
  }
  return make(VerdictCode::tight_tuning, 0.6 - 0.3 * persistence, reasons_of(loop));
}

/// Middle of the Harris range; nullopt for integrating loops, which are often meant to be slow.
std::optional<double> middle_harris(const Evidence& evidence) {
  const loop::Performance& performance = evidence.performance;
  if (evidence.integrating || !performance.harris_low || !performance.harris_high) {
    return std::nullopt;
  }
  return std::sqrt(*performance.harris_low * *performance.harris_high);
}

Verdict linear_quiet(const Case& loop) {
  const Evidence& evidence = loop.evidence;
  std::vector<std::string> reasons = with(reasons_of(loop), "No sustained oscillation.");
  if (has_flag(evidence, "pv_quantised")) {
    return make(VerdictCode::sensor_fault, 0.5,
                with(std::move(reasons), quantisation_text(evidence)));
  }
  if (!op_speaks(evidence)) {
    return make(VerdictCode::healthy, 0.3,
                with(std::move(reasons),
                     "op does not move or is not recorded: nothing is known of "
                     "controller and valve."));
  }
  const std::optional<double> harris = middle_harris(evidence);
  if (harris) {
    reasons.push_back("Harris index " + number(*evidence.performance.harris_low) + " to " +
                      number(*evidence.performance.harris_high) +
                      " over the plausible delays (1 is the best).");
  }
  if (harris && *harris < kSluggishHarris) {
    return make(VerdictCode::sluggish_tuning, 0.3 + (kSluggishHarris - *harris),
                std::move(reasons));
  }
  return make(VerdictCode::healthy, 0.6, std::move(reasons));
}

Verdict insufficient(const Evidence& evidence) {
  return make(VerdictCode::insufficient_data, 1.0, {evidence.data_quality.reason + "."});
}

Verdict unrefreshed(const Evidence& evidence) {
  const double factor = evidence.data_quality.compression_factor.value_or(1.0);
  return make(VerdictCode::sensor_fault, 0.7,
              {has_flag(evidence, "pv_frozen")
                   ? "pv stands still for hundreds of samples while op moves."
                   : "pv is renewed only every " + number(factor) + " samples on average."});
}

Verdict not_in_command() {
  Verdict verdict = make(VerdictCode::unexplained, 0.6,
                         {"pv stays many standard deviations away from its setpoint: the "
                          "controller is not in command, or has no integral action."});
  verdict.action =
      "Check whether an override or another controller holds the valve; if that is "
      "meant, disable the loop in the catalogue.";
  return verdict;
}

Verdict choose(const Evidence& evidence, const hos::Settings& settings) {
  if (!evidence.data_quality.usable || !evidence.hos) return insufficient(evidence);
  if (has_flag(evidence, "pv_frozen") || has_flag(evidence, "pv_held")) {
    return unrefreshed(evidence);
  }
  if (evidence.data_quality.saturated_fraction.value_or(0.0) > kSaturatedFraction) {
    return saturated(evidence);
  }
  if (has_flag(evidence, "sp_not_followed")) return not_in_command();
  const Case loop{evidence, judge_nonlinearity(*evidence.hos, settings), judge_valve(evidence)};
  const bool faulty = loop.valve.kind == Kind::sticks || loop.valve.kind == Kind::dead_band;
  if (loop.valve.measured && faulty) return faulty_position(loop);
  if (loop.nonlinearity.found) return nonlinear(loop);
  return oscillates(evidence) ? linear_oscillating(loop) : linear_quiet(loop);
}

}  // namespace

Verdict decide(const Evidence& evidence, const hos::Settings& settings) {
  Verdict verdict = choose(evidence, settings);
  if (has_flag(evidence, "short") && verdict.code != VerdictCode::insufficient_data) {
    verdict.confidence *= kShortRecord;
    verdict.reasons.emplace_back("Short record: fewer than 32 segments.");
  }
  return verdict;
}

}  // namespace loopscope::core::diagnosis
