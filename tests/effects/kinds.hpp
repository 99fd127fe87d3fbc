#pragma once

#include <string_view>
#include <vector>

#include "tests/effects/effects.hpp"
#include "tests/effects/generator.hpp"

namespace loopscope::tests::effects {

/// How records of one kind are made: a loop by one of the options, then each effect in turn.
struct Recipe {
  KindInfo info;
  std::vector<LoopOptions> options;
  std::vector<Dress> dresses;
  double most_at_limit = kMostAtLimit;
  std::vector<Dress> spread = {};  ///< those of `dresses` that have to be explainable alone
};

[[nodiscard]] const std::vector<Recipe>& all_recipes(Size size = Size::realistic);

/// Throws std::invalid_argument for an unknown kind.
[[nodiscard]] const Recipe& recipe_of(std::string_view kind, Size size = Size::realistic);

}  // namespace loopscope::tests::effects
