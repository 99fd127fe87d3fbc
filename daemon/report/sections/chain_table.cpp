#include "daemon/report/sections/chain_table.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/picture_rows.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using core::model::AskedBy;
using core::model::Explanation;
using core::model::Parameter;
using core::model::Step;

std::string parameter_text(const Parameter& parameter) {
  const std::string unit = parameter.unit.empty() ? "" : " " + std::string(parameter.unit);
  std::string text =
      fmt::format("{} {}{}", in_words(parameter.name), digits(parameter.value), unit);
  if (parameter.low && parameter.high)
    text += fmt::format(" ({} to {})", digits(*parameter.low), digits(*parameter.high));
  return text;
}

Fields test_fields(const AskedBy& by) {
  return {
      {"test", in_words(by.test)}, {"p", core::text::p_equals(by.p)}, {"statement", by.statement}};
}

/// Below the picture after the step: whether those who asked are content now.
List asked_again(const Step& step) {
  List answers;
  for (const AskedBy& by : step.asked_by)
    if (by.p_after)
      answers.emplace_back(
          Fields{{"test", in_words(by.test)}, {"p", core::text::p_equals(*by.p_after)}});
  return answers;
}

/// None or one, which a template shows the same way.
std::span<const Picture> if_drawn(const StepPictures* pictures, Picture StepPictures::*which) {
  if (pictures == nullptr) return {};
  return {&(pictures->*which), 1};
}

Fields step_fields(const Step& step, const StepPictures* pictures) {
  return {{"before", picture_rows(if_drawn(pictures, &StepPictures::before))},
          {"error_before", digits(step.holdout_error_before)},
          {"tests", rows(step.asked_by, test_fields)},
          {"effect", in_words(name(step.effect))},
          {"figures", parameters_text(step)},
          {"after", picture_rows(if_drawn(pictures, &StepPictures::after))},
          {"error_after", digits(step.holdout_error_after)},
          {"asked_again", asked_again(step)}};
}

}  // namespace

std::string parameters_text(const Step& step) {
  std::string text;
  for (const Parameter& parameter : step.parameters)
    text += (text.empty() ? "" : "; ") + parameter_text(parameter);
  if (!step.law.empty()) text += "; law " + std::string(step.law);
  return text;
}

Markup chain_table(const Explanation& explanation, std::span<const StepPictures> pictures) {
  if (!explanation.excited || explanation.steps.empty()) return {};
  List steps;
  for (std::size_t k = 0; k < explanation.steps.size(); ++k) {
    const auto found = std::ranges::find(pictures, k, &StepPictures::step);
    steps.push_back(step_fields(explanation.steps[k], found == pictures.end() ? nullptr : &*found));
  }
  return render("chain_table", {{"steps", steps}});
}

}  // namespace loopscope::daemon
