#include "core/diagnosis/model_words.hpp"

#include <cmath>

#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Of a cycle that was simulated the share is an upper bound (apply_limit_cycle_evidence()).
bool is_rough(const model::Explanation& explanation) {
  return explanation.excited && explanation.error_kind == model::ErrorKind::one_step &&
         explanation.unexplained.fraction >= kNearlyAll;
}

}  // namespace

std::string left_text(const model::Explanation& explanation) {
  const model::Unexplained& rest = explanation.unexplained;
  const std::string left = text::percent(rest.fraction), p = text::p_text(rest.whiteness_p);
  if (left != "0 %")
    return "The model leaves " + left +
           " of the explainable error unexplained (residual whiteness p " + p + ")." +
           (is_rough(explanation)
                ? " It describes the loop in part only: take its figures as rough."
                : "");
  if (rest.whiteness_p > model::kSignificant)
    return "The model explains all of the explainable error (residual whiteness p " + p + ").";
  return "The model explains nearly all of the explainable error, but its residual is not white "
         "(p " +
         p + ").";
}

// A step is scored on all samples, each half by the fit of the other; the floor, and the share that
// is left, on one of the halves, where the floor is at most the error.
std::string floor_text(const model::Explanation& explanation) {
  if (explanation.steps.empty() || !std::isfinite(explanation.noise_floor)) return {};
  const double last = explanation.steps.back().holdout_error_after;
  if (!(explanation.noise_floor > last) ||
      text::number(explanation.noise_floor) == text::number(last))
    return {};
  const std::string left = text::percent(explanation.unexplained.fraction);
  return "The noise floor stands above the last error because it is measured on one half of the "
         "samples only, the noisier one, and the errors of the effects on both. On the same "
         "samples the model " +
         (left == "0 %" ? "reaches the floor."
                        : "leaves " + left + " of what lies above the floor.");
}

std::string effects_text(const model::Explanation& explanation) {
  if (explanation.steps.empty()) return {};
  const double before = explanation.steps.front().holdout_error_before;
  const double after = explanation.steps.back().holdout_error_after;
  if (!(before > 0.0) || !(after < before)) return {};
  return "The effects take " + text::percent(1.0 - after / before) +
         " off the error of the linear model; how sure they are is what evidence and p say.";
}

}  // namespace loopscope::core::diagnosis
