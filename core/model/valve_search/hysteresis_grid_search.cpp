#include "core/model/valve_search/hysteresis_grid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/fit/fit_variants.hpp"

namespace loopscope::core::model {
namespace {

/// Of op's span: below the first a valve hides in any record's noise, above the last it rests.
constexpr double kNarrowest = 0.02;
constexpr double kWidest = 0.9;
/// Play is smooth in its band.
constexpr double kPlayStep = 1.15;
/// So smooth that every third band shows where the best one is: of 283 searches, 102 with a play
/// that gained 5, the net so thinned and filled again about its two leaders missed the best in one.
constexpr std::size_t kStride = 3;
constexpr std::size_t kFollowed = 2;

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

/// The process that goes with a play: without it the linear loop takes the play for delay.
GridResult behind_play(const LoopData& data, const Fit& now, double band, double to_beat) {
  const Valve valve{ValveLaw::he, band, 0.0, 1.0};
  const Structure rich = with(now.structure, std::make_shared<ValveEffect>(valve));
  Structure plain = rich;
  plain.process = glance(data, rich);
  plain.two_taps = false;
  plain.second_order = false;
  Fit fit = polish(data, plain, 2, to_beat);
  if (rich.second_order || rich.two_taps) {
    Fit other = polish(data, rich, 3, std::min(fit.fit_error, to_beat));
    if (other.fit_error < fit.fit_error) fit = std::move(other);
  }
  return {std::move(fit.structure), fit.fit_error};
}

/// Plays by the place of their bands on the net.
class PlayNet {
 public:
  PlayNet(const LoopData& data, const Fit& now, double span, double to_beat)
      : data_(data), now_(now), span_(span), to_beat_(to_beat) {}

  void look_at(std::size_t place) {
    if (place >= hysteresis_net_bands() || finds_.contains(place)) return;
    const double band = kNarrowest * span_ * std::pow(kPlayStep, static_cast<double>(place));
    const double to_beat = finds_.empty() ? to_beat_ : std::min(to_beat_, best().fit_error);
    finds_.emplace(place, behind_play(data_, now_, band, to_beat));
  }
  /// All places up to the next ones that the coarse net has.
  void look_about(std::size_t place) {
    for (std::size_t i = 1; i < kStride; ++i) {
      if (place >= i) look_at(place - i);
      look_at(place + i);
    }
  }
  [[nodiscard]] std::vector<std::size_t> leading(std::size_t count) const {
    std::vector<std::pair<double, std::size_t>> ranked;
    for (const auto& [place, find] : finds_) {
      // What has overflown comes last.
      ranked.emplace_back(std::isnan(find.fit_error) ? kNoError : find.fit_error, place);
    }
    std::ranges::sort(ranked);
    std::vector<std::size_t> places;
    ranked.resize(std::min(count, ranked.size()));
    places.reserve(ranked.size());
    for (const auto& [error, place] : ranked) places.push_back(place);
    return places;
  }
  [[nodiscard]] const GridResult& best() const { return finds_.at(leading(1).front()); }

 private:
  static constexpr double kNoError = std::numeric_limits<double>::infinity();
  const LoopData& data_;
  const Fit& now_;
  double span_;
  double to_beat_;
  std::map<std::size_t, GridResult> finds_;
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

/// Of valves that leave the same error, as those that never move do, the first one stays.
GridResult best_of(const LoopData& data, const std::vector<EffectPtr>& valves, Structure start) {
  constexpr double kRounding = 1e-5;  // of an error, in single digits
  const std::vector<double> errors = FitVariants(data, start).fit_errors(valves, Digits::single);
  std::size_t best = 0;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    if (std::isnan(errors[best]) || errors[i] < (1.0 - kRounding) * errors[best]) best = i;
  }
  start.effects.back() = valves[best];
  return {std::move(start), errors[best]};
}

}  // namespace

std::size_t hysteresis_net_bands() {
  return static_cast<std::size_t>(std::ceil(std::log(kWidest / kNarrowest) / std::log(kPlayStep)));
}

std::optional<GridResult> find_play(const LoopData& data, const Fit& now, double to_beat) {
  const auto [low, high] = std::ranges::minmax(data.op);
  if (!(high > low)) return std::nullopt;
  PlayNet net(data, now, high - low, to_beat);
  for (std::size_t i = 0; i < hysteresis_net_bands(); i += kStride) net.look_at(i);
  // Of 133 plays that gained 5 none lay between bands that all left more than the model as it
  // stands.
  if (net.best().fit_error > now.fit_error) return net.best();
  for (const std::size_t place : net.leading(kFollowed)) net.look_about(place);
  return net.best();
}

std::vector<GridResult> find_sticking(const LoopData& data, const Fit& now,
                                      const GridResult& play) {
  const EffectPtr& best_play = play.structure.effects.back();
  const double band = best_play->as_valve()->valve().stickband_percent;
  const Structure linear = with(now.structure, best_play);
  std::vector<GridResult> found;
  for (const Mesh& mesh : kMeshes) {
    const std::vector<EffectPtr> valves = valves_of(mesh, band);
    GridResult best = best_of(data, valves, play.structure);
    GridResult other = best_of(data, valves, linear);
    if (other.fit_error < best.fit_error) best = std::move(other);
    found.push_back(std::move(best));
  }
  return found;
}

}  // namespace loopscope::core::model
