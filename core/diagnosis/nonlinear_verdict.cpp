#include "core/diagnosis/nonlinear_verdict.hpp"

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

}  // namespace

Verdict nonlinear_verdict(const Case& loop) {
  const double belief = loop.nonlinearity.belief;
  const double p = loop.nonlinearity.p;
  if (!op_speaks(loop.evidence)) {
    return make(VerdictCode::nonlinear_unexplained, 0.4 * belief,
                with(reasons_of(loop),
                     "op does not move: the loop itself says nothing about its "
                     "valve; the cause may lie outside."),
                p);
  }
  if (oversized(loop.evidence)) {
    return oversized_valve(loop, coupling_or_oscillation_p(loop));
  }
  if (loop.valve.kind == Kind::sticks) {
    return make(VerdictCode::valve_stiction, 0.3 + 0.3 * loop.valve.score + 0.2 * belief,
                reasons_of(loop), coupling_or_oscillation_p(loop));
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
