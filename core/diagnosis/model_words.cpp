#include "core/diagnosis/model_words.hpp"

#include <cmath>
#include <string_view>

#include "core/diagnosis/verdicts/number_words.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// "S 4.2 %, J 1.1 %, law kano"
std::string parameters_text(const model::Step& step) {
  std::string text;
  const auto add = [&text](std::string_view part) {
    if (!text.empty()) text += ", ";
    text += part;
  };
  for (const model::Parameter& parameter : step.parameters) {
    add(parameter.name);
    text.append(" ").append(number(parameter.value));
    if (!parameter.unit.empty()) text.append(" ").append(parameter.unit);
  }
  if (!step.law.empty()) {
    add("law ");
    text += step.law;
  }
  return text;
}

std::string statement_of(const model::Step& step) {
  if (!step.statement.empty()) return step.statement;
  const std::string parameters = parameters_text(step);
  std::string text = "The model includes ";
  text += model::name(step.effect);
  if (!parameters.empty()) text.append(" (").append(parameters).append(")");
  return text + ".";
}

/// What is left of the error that a model can explain, in agreement with the test of whiteness.
std::string left_text(const model::Unexplained& rest) {
  const std::string left = percent(rest.fraction), p = p_text(rest.whiteness_p);
  if (left != "0 %")
    return "The model leaves " + left +
           " of the explainable error unexplained (residual whiteness p " + p + ").";
  if (rest.whiteness_p > model::kSignificant)
    return "The model explains all of the explainable error (residual whiteness p " + p + ").";
  return "The model explains nearly all of the explainable error, but its residual is not white "
         "(p " +
         p + ").";
}

}  // namespace

std::string step_text(const model::Step& step) {
  return statement_of(step) +
         " One-step prediction error on held-out samples: " + number(step.holdout_error_before) +
         " -> " + number(step.holdout_error_after) + " (evidence " + number(step.evidence) +
         ", p " + p_text(step.p) + ").";
}

std::string unexplained_text(const model::Explanation& explanation) {
  const model::Unexplained& rest = explanation.unexplained;
  std::string text = left_text(rest);
  if (!rest.statement.empty()) text += " " + rest.statement;
  for (const model::Question& question : explanation.questions) {
    const bool said = rest.statement.find(question.statement) != std::string::npos;
    if (!said) text += " " + question.statement;
  }
  return text;
}

std::string closed_loop_text(const model::ClosedLoop& loop) {
  const std::string sensitivity = std::isfinite(loop.peak_sensitivity)
                                      ? "peak sensitivity " + number(loop.peak_sensitivity)
                                      : std::string("unstable");
  const std::string period =
      loop.period_s > 0.0 ? ", period " + duration(loop.period_s) : std::string(", no oscillation");
  return "Closed loop by the fitted model and the recorded controller: " + sensitivity +
         ", damping " + number(loop.damping) + period + ", settles in " +
         duration(loop.settling_s) + ".";
}

}  // namespace loopscope::core::diagnosis
