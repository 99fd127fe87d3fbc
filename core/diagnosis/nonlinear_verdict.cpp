#include "core/diagnosis/nonlinear_verdict.hpp"

#include <algorithm>
#include <optional>

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

/// NGI in multiples of its limit at which the published rule is believed in full. White and AR(1)
/// noise pass the limit itself in 3 to 8 % of the records, 2.4 times the limit in at most 0.3 % (a
/// random walk in 2.6 %), four times it never (0.4 %): tests/core/diagnosis/nonlinearity_test.
constexpr double kConvincingStrength = 4.0;

/// How far the published rule is believed, 0 to 1: skewed noise passes it too, but without a
/// bifrequency that stands out.
double belief_in(const Case& loop) {
  const double strength = std::min(1.0, loop.nonlinearity.strength / kConvincingStrength);
  return loop.evidence.hos->peaks.empty() ? 0.5 * strength : strength;
}

}  // namespace

Verdict nonlinear_verdict(const Case& loop) {
  const double belief = belief_in(loop);
  const std::optional<double> p = loop.evidence.hos->nonlinear_p;
  if (!op_speaks(loop.evidence)) {
    return make(VerdictCode::nonlinear_unexplained, 0.4 * belief,
                with(reasons_of(loop),
                     "op does not move: the loop itself says nothing about its "
                     "valve; the cause may lie outside."),
                p);
  }
  if (oversized(loop.evidence)) {
    return oversized_valve(loop, coupling_or_oscillation_p(loop.evidence));
  }
  if (loop.valve.kind == Kind::sticks) {
    return make(VerdictCode::valve_stiction, 0.3 + 0.3 * loop.valve.score + 0.2 * belief,
                reasons_of(loop), coupling_or_oscillation_p(loop.evidence));
  }
  if (loop.valve.kind == Kind::follows) {
    // A step of the load or a changed gain looks the same without a model of the loop.
    return make(VerdictCode::process_nonlinearity, 0.4 * belief,
                with(reasons_of(loop),
                     "The valve follows its signal: the cause lies in the process "
                     "or in what disturbs it."),
                p);
  }
  return make(VerdictCode::nonlinear_unexplained, 0.5 * belief, reasons_of(loop), p);
}

}  // namespace loopscope::core::diagnosis
