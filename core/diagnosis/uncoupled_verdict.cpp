#include "core/diagnosis/uncoupled_verdict.hpp"

#include <optional>

#include "core/diagnosis/implied_tuning.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

/// A line from outside is a sinusoid once the loop has filtered it; a sustained oscillation of no
/// clear shape may as well be a limit cycle of the loop's own valve and is believed less.
constexpr double kSinusoidal = 0.4;
constexpr double kUnclearShape = 0.6;
/// Without support from the bispectrum the shapes alone have to speak more clearly.
constexpr double kClearShapes = 0.75;

/// An oscillation of a loop whose output says nothing: one that stands still cannot make it, one
/// that was not recorded may.
Verdict oscillating_without_op(const Case& loop) {
  const std::optional<double> p = oscillation_p(loop.evidence);
  if (has_flag(loop.evidence, "op_missing")) {
    return make(VerdictCode::unexplained, 0.4,
                with(reasons_of(loop),
                     "op is not recorded: whether the controller makes the "
                     "oscillation cannot be told."),
                p);
  }
  return make(VerdictCode::external_disturbance, 0.5,
              with(reasons_of(loop), "op does not move, so the controller does not make it."), p);
}

Verdict oscillating(const Case& loop) {
  if (!op_speaks(loop.evidence)) return oscillating_without_op(loop);
  const std::optional<double> p = oscillation_p(loop.evidence);
  if (oversized(loop.evidence)) return oversized_valve(loop, p);
  if (loop.valve.kind == Kind::sticks && loop.valve.score >= kClearShapes) {
    return make(VerdictCode::valve_stiction, 0.3 + 0.3 * loop.valve.score,
                with(reasons_of(loop),
                     "A symmetric limit cycle carries odd harmonics only, to "
                     "which the bispectrum is blind: the shapes decide."),
                p);
  }
  const double persistence = loop.evidence.oscillation.persistence.value_or(0.0);
  if (sustained(loop.evidence)) {
    const bool sinusoidal = loop.evidence.shape.shape_index.value_or(1.0) <= kSinusoidal;
    return make(VerdictCode::external_disturbance,
                (0.3 + 0.3 * persistence) * (sinusoidal ? 1.0 : kUnclearShape), reasons_of(loop),
                p);
  }
  return make(VerdictCode::tight_tuning, 0.6 - 0.3 * persistence, reasons_of(loop), p);
}

/// Where the controller is known, its integral time says what is long.
bool forgets_in_time(const Evidence& evidence) {
  return evidence.model && evidence.model->closed_loop &&
         memory_ratio(*evidence.model->closed_loop, evidence.performance) <= kLongMemory;
}

Verdict quiet(const Case& loop) {
  const Evidence& evidence = loop.evidence;
  std::vector<std::string> reasons = with(reasons_of(loop), "No sustained oscillation.");
  if (has_flag(evidence, "pv_quantised")) {
    return make(VerdictCode::sensor_fault, kGridConfidence,
                with(std::move(reasons), quantisation_text(evidence)));
  }
  if (!op_speaks(evidence)) {
    return make(VerdictCode::healthy, 0.3,
                with(std::move(reasons),
                     "op does not move or is not recorded: nothing is known of "
                     "controller and valve."));
  }
  const std::optional<double> harris = middle_harris(evidence);
  if (harris) reasons.push_back(harris_text(evidence));
  if (creeps(evidence) && !forgets_in_time(evidence)) {
    return make(VerdictCode::sluggish_tuning, creeping_confidence(evidence), std::move(reasons),
                evidence.performance.harris_p);
  }
  return make(VerdictCode::healthy, 0.6, std::move(reasons));
}

}  // namespace

Verdict uncoupled_verdict(const Case& loop) {
  return oscillates(loop.evidence) ? oscillating(loop) : quiet(loop);
}

}  // namespace loopscope::core::diagnosis
