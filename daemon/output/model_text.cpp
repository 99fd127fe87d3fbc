#include "daemon/output/model_text.hpp"

#include <fmt/format.h>

#include "core/diagnosis/model_words.hpp"
#include "daemon/output/text_line.hpp"

namespace loopscope::daemon {

std::string model_text(const core::model::Explanation& explanation) {
  if (!explanation.excited) {
    return text_line("model", "claims nothing: " + explanation.excitation);
  }
  const core::model::Baseline& baseline = explanation.baseline;
  std::string text = text_line(
      "model", fmt::format("{}; error on unseen samples {} ({}, floor {})", baseline.description,
                           figure_text(baseline.holdout_error), name(explanation.error_kind),
                           figure_text(explanation.noise_floor)));
  for (std::size_t i = 0; i < explanation.steps.size(); ++i) {
    const core::model::Step& step = explanation.steps[i];
    text += text_line(fmt::format("  + step {}", i + 1),
                      fmt::format("{}: {}", name(step.effect), core::diagnosis::step_text(step)));
  }
  text += text_line("  left", core::diagnosis::unexplained_text(explanation));
  if (explanation.closed_loop) {
    text += text_line("  closed loop", core::diagnosis::closed_loop_text(*explanation.closed_loop));
  }
  return text;
}

}  // namespace loopscope::daemon
