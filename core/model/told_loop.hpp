#pragma once

#include <optional>

#include "core/model/record/model_input.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/selection/story.hpp"

namespace loopscope::core::model {

/// An explanation with the fits that it was read off.
struct ToldLoop {
  Explanation explanation;
  /// Every sample a row. Without chapters where `renewals` has them.
  Story samples;
  /// Of a held sensor that is renewed often enough: the same on the rows of its renewals.
  std::optional<Story> renewals;
};

/// explain(), and what it keeps to itself.
[[nodiscard]] std::optional<ToldLoop> tell_loop(const ModelInput& input);

}  // namespace loopscope::core::model
