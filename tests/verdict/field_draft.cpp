#include "tests/verdict/field_draft.hpp"

#include "tests/generators/values.hpp"

namespace loopscope::tests::verdict {

void measure_swing(FieldDraft& draft, std::size_t samples, model::Draw& draw) {
  const model::FieldLoop clear = run_field_loop(draft.settings, samples, draw);
  draft.swing_pv = generators::standard_deviation(clear.pv);
  draft.swing_op = generators::standard_deviation(clear.op);
}

SimulatedLoop run_draft(const FieldDraft& draft, const std::string& family, model::Draw& draw) {
  const model::FieldSettings& settings = draft.settings;
  SimulatedLoop loop =
      loop_of(run_field_loop(settings, draft.samples, draw), settings.integrating, draft.truth);
  loop.truth.family = family;
  loop.limits = {settings.op_low, settings.op_high};
  return loop;
}

}  // namespace loopscope::tests::verdict
