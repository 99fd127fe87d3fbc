#include "tests/verdict/naming.hpp"

#include <algorithm>

#include "core/diagnosis/evidence/structure.hpp"

namespace loopscope::tests::verdict {

using Code = core::diagnosis::VerdictCode;

bool is_fault(Code code) {
  return core::diagnosis::catalogue_entry(code).weight > 0.0;
}

bool blames(Code code, core::plant::Fault fault) {
  return core::diagnosis::catalogue_entry(code).blames == fault;
}

bool is_valve(Code code) {
  return blames(code, core::plant::Fault::friction) || blames(code, core::plant::Fault::valve);
}

bool has_step(const core::Evidence& evidence, core::model::EffectKind effect) {
  return evidence.model && std::ranges::any_of(evidence.model->steps, [&](const auto& step) {
           return step.effect == effect;
         });
}

bool is_at_no_limit(const core::Evidence& evidence) {
  return evidence.data_quality.saturated_fraction.value_or(0.0) == 0.0 &&
         (!evidence.op_at_ends || evidence.op_at_ends->share == 0.0) &&
         !has_step(evidence, core::model::EffectKind::valve_saturation);
}

bool may_be_named(Code code, const core::Evidence& evidence) {
  if (code == Code::nonlinear_unexplained || code == Code::valve_oversized) return false;
  if (code == Code::valve_saturation && is_at_no_limit(evidence)) return false;
  const bool of_op = is_valve(code) || blames(code, core::plant::Fault::tuning);
  return is_fault(code) && (!of_op || core::diagnosis::op_speaks(evidence));
}

}  // namespace loopscope::tests::verdict
