#include "core/model/hysteresis_net.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit_variants.hpp"

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
                            Mesh{ValveLaw::kano, 1.006, {0.2, 0.33, 0.5, 0.75, 1.0}}};

Structure behind(Structure structure, EffectPtr valve) {
  structure.effects.push_back(std::move(valve));
  return structure;
}

/// The process that goes with a play: without it the linear loop takes the play for delay.
NetFind behind_play(const LoopData& data, const Fit& now, double band) {
  const Valve valve{ValveLaw::he, band, 0.0, 1.0};
  const Structure rich = behind(now.structure, std::make_shared<ValveEffect>(valve));
  Structure plain = rich;
  plain.process = glance(data, rich).shape;
  plain.two_taps = false;
  plain.second_order = false;
  Fit fit = polish(data, plain, 2);
  if (rich.second_order || rich.two_taps) {
    Fit other = polish(data, rich, 3);
    if (other.fit_error < fit.fit_error) fit = std::move(other);
  }
  return {std::move(fit.structure), fit.fit_error};
}

/// The best of the valves that were looked at behind one process.
class Search {
 public:
  Search(const LoopData& data, Structure start)
      : start_(std::move(start)), variants_(data, start_) {}

  void look_at(const EffectPtr& valve) {
    const double error = variants_.fit_error(valve);
    if (best_ && error >= error_) return;
    best_ = valve;
    error_ = error;
  }
  [[nodiscard]] NetFind best() const {
    NetFind find{start_, error_};
    find.structure.effects.back() = best_;
    return find;
  }

 private:
  Structure start_;
  FitVariants variants_;
  EffectPtr best_;
  double error_ = 0.0;
};

/// The valves of one law about a play of that band.
std::vector<EffectPtr> valves_of(const Mesh& mesh, double play) {
  std::vector<EffectPtr> valves;
  for (double band = kLeastOfPlay * play; band < kMostOfPlay * play; band *= mesh.step) {
    for (const double share : mesh.jump_shares) {
      const double jump = share * band;
      valves.push_back(std::make_shared<ValveEffect>(Valve{mesh.law, band, jump, 1.0}));
    }
  }
  return valves;
}

NetFind best_of(const LoopData& data, const std::vector<EffectPtr>& valves,
                const Structure& start) {
  Search search(data, start);
  for (const EffectPtr& valve : valves) search.look_at(valve);
  return search.best();
}

}  // namespace

std::size_t hysteresis_net_bands() {
  return static_cast<std::size_t>(std::ceil(std::log(kWidest / kNarrowest) / std::log(kPlayStep)));
}

std::optional<NetFind> find_play(const LoopData& data, const Fit& now) {
  const auto [low, high] = std::ranges::minmax(data.op);
  std::optional<NetFind> best;
  for (double band = kNarrowest * (high - low); band < kWidest * (high - low); band *= kPlayStep) {
    NetFind find = behind_play(data, now, band);
    if (!best || find.fit_error < best->fit_error) best = std::move(find);
  }
  return best;
}

std::vector<NetFind> find_sticking(const LoopData& data, const Fit& now, const NetFind& play) {
  const EffectPtr& best_play = play.structure.effects.back();
  const double band = dynamic_cast<const ValveEffect&>(*best_play).valve().stickband_percent;
  const Structure linear = behind(now.structure, best_play);
  std::vector<NetFind> found;
  for (const Mesh& mesh : kMeshes) {
    const std::vector<EffectPtr> valves = valves_of(mesh, band);
    NetFind best = best_of(data, valves, play.structure);
    NetFind other = best_of(data, valves, linear);
    if (other.fit_error < best.fit_error) best = std::move(other);
    found.push_back(std::move(best));
  }
  return found;
}

}  // namespace loopscope::core::model
