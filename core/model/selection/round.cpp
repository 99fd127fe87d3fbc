#include "core/model/selection/round.hpp"

#include <optional>

namespace loopscope::core::model {
namespace {

/// A sudden step is seen by fit and score over so many rows from so many before it on: about as
/// far as its place moves while it is fitted. A place whose first sample the fit does not see
/// leaves one of its coefficients free.
constexpr std::size_t kStepBefore = 12;
constexpr std::size_t kStepSamples = 40;

}  // namespace

LoopData judged_on(const LoopData& original, const Structure& structure) {
  LoopData data = original;
  for (const EffectPtr& effect : structure.effects) {
    const std::optional<std::size_t> at = effect->moment();
    if (!at) continue;
    const std::size_t row = data.grid.row_from(*at);
    const std::size_t from = row < kStepBefore ? 0 : row - kStepBefore;
    data.rows = seen_by_both(data.rows, from, kStepSamples);
  }
  return data;
}

}  // namespace loopscope::core::model
