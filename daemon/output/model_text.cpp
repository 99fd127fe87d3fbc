#include "daemon/output/model_text.hpp"

#include <fmt/format.h>

#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/text/phrases.hpp"
#include "daemon/output/text_line.hpp"

namespace loopscope::daemon {
namespace {

std::string asked_by_text(const core::model::AskedBy& by) {
  std::string text = fmt::format("asked for by {} ({}", by.test, core::text::p_equals(by.p));
  if (by.p_after) text += ", afterwards " + core::text::p_text(*by.p_after);
  text += ")";
  return by.statement.empty() ? text : text + ": " + by.statement;
}

/// Below a step, where its words stand: which residual tests led to it, and whether they are
/// content now.
std::string asked_lines(const core::model::Step& step) {
  if (step.asked_by.empty())
    return text_line("", "  no residual test pointed to it; a first screening did");
  std::string text;
  for (const core::model::AskedBy& by : step.asked_by)
    text += text_line("", "  " + asked_by_text(by));
  return text;
}

}  // namespace

std::string model_text(const core::model::Explanation& explanation) {
  if (!explanation.excited) {
    return text_line("model", "process not identified. " + explanation.excitation);
  }
  const core::model::Baseline& baseline = explanation.baseline;
  std::string text = text_line(
      "model", fmt::format("{}; error on held-out samples {} ({}, floor {})", baseline.description,
                           figure_text(baseline.holdout_error), name(explanation.error_kind),
                           figure_text(explanation.noise_floor)));
  for (std::size_t i = 0; i < explanation.steps.size(); ++i) {
    const core::model::Step& step = explanation.steps[i];
    text += text_line(fmt::format("  + step {}", i + 1),
                      fmt::format("{}: {}", name(step.effect), core::diagnosis::step_text(step)));
    text += asked_lines(step);
  }
  for (const std::string& words :
       {core::diagnosis::effects_text(explanation), core::diagnosis::floor_text(explanation)})
    if (!words.empty()) text += text_line("", words);
  text += text_line("  left", core::diagnosis::unexplained_text(explanation));
  if (explanation.closed_loop) {
    text += text_line("  closed loop", core::diagnosis::closed_loop_text(*explanation.closed_loop));
  }
  return text;
}

}  // namespace loopscope::daemon
