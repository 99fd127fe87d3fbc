#include "tests/effects/realistic.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace loopscope::tests::effects {
namespace {

constexpr std::array kSpread = {add_stiction,      add_deadband,
                                add_saturation,    add_characteristic,
                                add_oscillation,   add_nonlinear_neighbour,
                                add_gain_change,   add_process_nonlinearity,
                                add_overflow_weir, add_hunting_positioner,
                                add_delay_change,  add_intermittent_stiction};

/// Of the spread ones, those that a loop at rest hides or its small moves hardly show.
constexpr std::array kNeedMoves = {add_deadband, add_gain_change, add_delay_change,
                                   add_overflow_weir};

template <typename Dresses>
bool contains(const Dresses& dresses, Dress dress) {
  return std::find(dresses.begin(), dresses.end(), dress) != dresses.end();
}

Recipe realistic(Recipe recipe) {
  std::copy_if(recipe.dresses.begin(), recipe.dresses.end(), std::back_inserter(recipe.spread),
               [](Dress dress) { return contains(kSpread, dress); });
  const bool moves = std::any_of(recipe.spread.begin(), recipe.spread.end(),
                                 [](Dress dress) { return contains(kNeedMoves, dress); });
  for (LoopOptions& options : recipe.options) {
    if (!recipe.spread.empty()) options.noise = kQuiet;
    if (!moves) continue;
    options.moves = Moves::small;
    options.reach = kFarMoves;
  }
  return recipe;
}

}  // namespace

std::vector<Recipe> realistic(std::vector<Recipe> recipes) {
  for (Recipe& recipe : recipes) recipe = realistic(std::move(recipe));
  return recipes;
}

}  // namespace loopscope::tests::effects
