#include "core/diagnosis/action.hpp"

#include <algorithm>

#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/verdicts/number_words.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

bool is_tuning(VerdictCode code) {
  return catalogue_entry(code).blames == plant::Fault::tuning;
}

/// What would show where the nonlinearity is.
std::string record_more(const Evidence& evidence) {
  if (!op_speaks(evidence)) return "Record the controller output (op), then analyse again.";
  if (evidence.shape.mv_op_width)
    return "Do a stroke test; compare pv with the valve position at several levels.";
  return std::string(catalogue_entry(VerdictCode::nonlinear_unexplained).action);
}

}  // namespace

std::string action_for(VerdictCode code, const Evidence& evidence, const Causes& causes,
                       double line) {
  if (code == VerdictCode::nonlinear_unexplained) return record_more(evidence);
  std::string own(catalogue_entry(code).action);
  // The words for saturation say so already.
  if (code == VerdictCode::valve_saturation) return own;
  if (catalogue_entry(code).withholds_tuning) return own + tuning_waits();
  if (!is_tuning(code)) return own;
  const auto first = std::ranges::find_if(causes, [&](const WeighedCause& cause) {
    return catalogue_entry(cause.code).withholds_tuning && cause.probability() >= line;
  });
  return first == causes.end() ? own : action_for(first->code, evidence, causes, line);
}

}  // namespace loopscope::core::diagnosis
