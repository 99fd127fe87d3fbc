#include "core/model/selection/locate_static_nonlinearity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/selection/nominate.hpp"

namespace loopscope::core::model {
namespace {

/// In units of evidence. A trim's gain grows or falls along the whole travel; one that turns, an S,
/// is more often the process's (titration).
constexpr double kPriceOfAnS = 4.0;
/// A process has two shapes to choose from, a trim one: about 2 ln 2.
constexpr double kPriceOfTwoShapes = 1.0;

/// One shape that a bend may have, and what it has to gain on another to be believed.
struct BendShape {
  EffectPtr effect;
  double price = 0.0;
};

std::vector<BendShape> shapes_of(const LoopData& data, const CandidateFit& trial) {
  const EffectPtr& effect = trial.fit.fit.structure.effects.back();
  if (trial.kind() == EffectKind::valve_saturation) return {{effect, 0.0}};
  if (trial.kind() == EffectKind::process_nonlinearity) return {{effect, kPriceOfTwoShapes}};
  const bool simple = effect->column_count() == 1;  // its slope never turns
  std::vector<BendShape> shapes{{effect, simple ? 0.0 : kPriceOfAnS}};
  for (const EffectPtr& trim : nominate_trims(data)) shapes.push_back({trim, 0.0});
  return shapes;
}

double misfit(const LoopData& all, const Structure& structure) {
  const Fit rough = refine_last(all, polish(all, structure, 4), 0.5);
  const Fit fit = polish(all, rough.structure, 4);
  return static_cast<double>(all.rows.fit_count()) * std::log(fit.fit_error);
}

/// The shape with the process and noise of the trial that suit it best: a trial that stopped at a
/// poorer process would lose for that.
Structure best_start(const LoopData& all, const std::vector<CandidateFit*>& rivals,
                     const EffectPtr& shape) {
  const auto error = [&](const CandidateFit* rival) {
    return evaluate(all, with_last(rival->fit.fit.structure, shape)).fit_error;
  };
  return with_last((*std::ranges::min_element(rivals, {}, error))->fit.fit.structure, shape);
}

/// n ln(error) of the likeliest shape of a trial, its price included.
double least_misfit(const LoopData& all, const std::vector<CandidateFit*>& rivals,
                    const CandidateFit& trial) {
  double least = std::numeric_limits<double>::infinity();
  for (const BendShape& shape : shapes_of(all, trial)) {
    const Structure structure = best_start(all, rivals, shape.effect);
    least = std::min(least, misfit(all, structure) + shape.price);
  }
  return least;
}

}  // namespace

bool is_bend(EffectKind kind) {
  using enum EffectKind;
  return kind == valve_saturation || kind == valve_characteristic || kind == process_nonlinearity;
}

void locate_static_nonlinearity(const LoopData& data, std::vector<CandidateFit>& trials) {
  if (!data.without.keeps(Mechanism::bends_told_apart)) return;
  if (trials.empty() || !is_bend(trials.front().kind())) return;
  std::vector<CandidateFit*> rivals;
  for (CandidateFit& trial : trials) {
    if (is_bend(trial.kind()) && trial.enters()) rivals.push_back(&trial);
  }
  if (rivals.size() < 2) return;
  const LoopData all = seen_whole(data);
  const auto likeliest = std::ranges::min_element(
      rivals, {}, [&](const CandidateFit* trial) { return least_misfit(all, rivals, *trial); });
  const auto at = trials.begin() + (*likeliest - trials.data());
  std::rotate(trials.begin(), at, at + 1);
}

}  // namespace loopscope::core::model
