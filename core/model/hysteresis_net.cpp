#include "core/model/hysteresis_net.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"

namespace loopscope::core::model {
namespace {

/// Of op's span: below the first a valve hides in any record's noise, above the last it rests.
constexpr double kNarrowest = 0.02;
constexpr double kWidest = 0.9;
/// Play is smooth in its band.
constexpr double kPlayStep = 1.15;

/// Of the best play's band: a valve that sticks lies in between (measured on 28 loops: 0.64
/// to 1.4).
constexpr double kLeastOfPlay = 0.6;
constexpr double kMostOfPlay = 1.5;
/// A law and what its net looks at: each has its needle within so much of the band, and shows its
/// jump as coarsely.
struct Mesh {
  ValveLaw law;
  double step;
  std::vector<double> jump_shares;
};
const std::array kMeshes = {Mesh{ValveLaw::choudhury, 1.006, {0.2, 0.45, 0.8}},
                            Mesh{ValveLaw::kano, 1.006, {0.2, 0.33, 0.5, 0.75, 1.0}},
                            Mesh{ValveLaw::he, 1.015, {0.2, 0.35, 0.5, 0.7, 1.0}}};
const Mesh kGradualMesh = {ValveLaw::he_gradual, 1.04, {0.5, 0.75, 1.0}};

Structure behind(Structure structure, EffectPtr valve) {
  structure.effects.push_back(std::move(valve));
  return structure;
}

Structure behind(Structure structure, const Valve& valve) {
  return behind(std::move(structure), std::make_shared<ValveEffect>(valve));
}

/// The process that goes with a play: without it the linear loop takes the play for delay.
Fit behind_play(const LoopData& data, const Fit& now, double band) {
  Structure structure = behind(now.structure, {ValveLaw::he, band, 0.0, 1.0});
  structure.process = glance(data, structure).shape;
  structure.two_taps = false;
  structure.second_order = false;
  return polish(data, structure, 2);
}

void keep_better(Fit fit, Fit& best) {
  if (best.coefficients.empty() || fit.fit_error < best.fit_error) best = std::move(fit);
}

/// The best valve of one law behind a process that stands.
Fit best_of(const LoopData& data, const Mesh& mesh, const Structure& start, double play) {
  Fit best;
  for (double band = kLeastOfPlay * play; band < kMostOfPlay * play; band *= mesh.step) {
    for (const double share : mesh.jump_shares)
      keep_better(evaluate(data, behind(start, {mesh.law, band, share * band, 1.0})), best);
  }
  return best;
}

/// A valve that moves in slips of J stays for ever on the rungs that it began on.
Fit best_gradual(const LoopData& data, const Structure& start, double play) {
  Fit best;
  for (double band = kLeastOfPlay * play; band < kMostOfPlay * play; band *= kGradualMesh.step) {
    for (const double share : kGradualMesh.jump_shares) {
      for (const EffectPtr& valve : ValveEffect::on_every_rung(band, share * band, data.op.front()))
        keep_better(evaluate(data, behind(start, valve)), best);
    }
  }
  return best;
}

}  // namespace

std::size_t hysteresis_net_bands() {
  return static_cast<std::size_t>(std::ceil(std::log(kWidest / kNarrowest) / std::log(kPlayStep)));
}

std::optional<Fit> find_play(const LoopData& data, const Fit& now) {
  const auto [low, high] = std::ranges::minmax(data.op);
  std::optional<Fit> best;
  for (double band = kNarrowest * (high - low); band < kWidest * (high - low); band *= kPlayStep) {
    Fit fit = behind_play(data, now, band);
    if (!best || fit.fit_error < best->fit_error) best = std::move(fit);
  }
  return best;
}

std::vector<Fit> find_sticking(const LoopData& data, const Fit& now, const Fit& play) {
  const auto& effect = dynamic_cast<const ValveEffect&>(*play.structure.effects.back());
  const double band = effect.valve().stickband_percent;
  Structure by_play = play.structure;
  by_play.effects.pop_back();
  std::vector<Fit> found;
  for (const Mesh& mesh : kMeshes) {
    Fit best = best_of(data, mesh, by_play, band);
    keep_better(best_of(data, mesh, now.structure, band), best);
    found.push_back(std::move(best));
  }
  found.push_back(best_gradual(data, by_play, band));
  return found;
}

}  // namespace loopscope::core::model
