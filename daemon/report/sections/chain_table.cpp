#include "daemon/report/sections/chain_table.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/diagnosis/verdicts/number_words.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "daemon/report/figures/compact_svg.hpp"
#include "daemon/report/text/html_text.hpp"
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

std::string small_picture(const Picture& picture) {
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", svg_uri(picture.svg),
                     picture.width, picture.height, html(picture.alt));
}

std::string test_words(const AskedBy& by) {
  std::string text =
      "<p><b>" + html(in_words(by.test)) + "</b> " + html(core::diagnosis::p_equals(by.p));
  if (!by.statement.empty()) text += "<small>" + html(by.statement) + "</small>";
  return text + "</p>";
}

std::string tests_cell(const Step& step) {
  if (step.asked_by.empty()) return "<p>no residual test: a first screening</p>";
  std::string text;
  for (const AskedBy& by : step.asked_by) text += test_words(by);
  return text;
}

std::string effect_cell(const Step& step) {
  const std::string figures = parameters_text(step);
  std::string text = "<p><b>" + html(in_words(name(step.effect))) + "</b>";
  if (!figures.empty()) text += "<small>" + html(figures) + "</small>";
  return text + "</p>";
}

/// Below the picture after the step: whether those who asked are content now.
std::string content_words(const Step& step) {
  std::string text;
  for (const AskedBy& by : step.asked_by) {
    if (!by.p_after) continue;
    text += ", " + html(in_words(by.test)) + " " + html(core::diagnosis::p_equals(*by.p_after));
  }
  return text;
}

std::string step_row(const Step& step, const StepPictures* pictures) {
  return fmt::format(
      "<tr><td data-label=\"Residual before\">{}<p>error {}</p></td>"
      "<td data-label=\"Test\">{}</td><td data-label=\"Effect\">{}</td>"
      "<td data-label=\"Residual after\">{}<p>error {}{}</p></td></tr>\n",
      pictures == nullptr ? "" : small_picture(pictures->before), digits(step.holdout_error_before),
      tests_cell(step), effect_cell(step),
      pictures == nullptr ? "" : small_picture(pictures->after), digits(step.holdout_error_after),
      content_words(step));
}

}  // namespace

std::string parameters_text(const Step& step) {
  std::string text;
  for (const Parameter& parameter : step.parameters)
    text += (text.empty() ? "" : "; ") + parameter_text(parameter);
  if (!step.law.empty()) text += "; law " + std::string(step.law);
  return text;
}

std::string chain_table(const Explanation& explanation, std::span<const StepPictures> pictures) {
  if (!explanation.excited || explanation.steps.empty()) return {};
  std::string text =
      "<p class=\"note\">What led to each effect. Both pictures of a row have one scale and show "
      "the stretch in which the effect lowers the error most.</p>\n<table class=\"chain\"><thead>"
      "<tr><th>Residual before</th><th>Test that spoke</th><th>Effect</th><th>Residual after</th>"
      "</tr></thead><tbody>\n";
  for (std::size_t k = 0; k < explanation.steps.size(); ++k) {
    const auto found = std::ranges::find(pictures, k, &StepPictures::step);
    text += step_row(explanation.steps[k], found == pictures.end() ? nullptr : &*found);
  }
  return text + "</tbody></table>\n";
}

}  // namespace loopscope::daemon
