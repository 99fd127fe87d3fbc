#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/model/results/explanation.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// The drawn residuals of a step, before and after it.
struct StepPictures {
  std::size_t step = 0;  ///< of the explanation, 0 = the first
  Picture before;
  Picture after;
};

/// What led the model to each of its effects, a row a step: what was left, the residual test that
/// spoke, the effect, what is left then. A step without pictures has the errors alone. Empty for a
/// model that claims nothing or took nothing in.
[[nodiscard]] Markup chain_table(const core::model::Explanation& explanation,
                                 std::span<const StepPictures> pictures);

/// Fitted figures of a step with their intervals, plain text: "S 5 % (4.5 to 5.5); law kano".
[[nodiscard]] std::string parameters_text(const core::model::Step& step);

}  // namespace loopscope::daemon
