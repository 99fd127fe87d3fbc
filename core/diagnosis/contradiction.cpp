#include "core/diagnosis/contradiction.hpp"

#include <utility>

#include "core/diagnosis/model_confidence.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// A sensor that holds is renewed every second sample at best.
constexpr double kLeastHold = 1.5;
/// A grid of a hundredth of pv's standard deviation moves no figure of the loop.
constexpr double kFineGrid = 0.01;

std::string against_valve(const model::Step& step, const Case& loop) {
  if (loop.valve.measured && loop.valve.kind == ValvePattern::Kind::follows)
    return "the recorded valve position follows its signal";
  return step.beside_the_cycle ? "the loop cycles otherwise than about a valve's band" : "";
}

/// Before a vessel play alone keeps up a cycle, since nothing but the controller brings the level
/// back: the cycle is no witness of a slip. One that play does not have leaves its trace in what
/// play explains, where that is much (an error 7 % lower) and nothing is left.
bool explains_the_cycle(const model::Step& play, const Evidence& evidence) {
  constexpr double kSlipWouldShow = 300.0;
  return evidence.integrating && play.cycles_as_if_stuck && play.evidence >= kSlipWouldShow &&
         !leaves_structure(*evidence.model);
}

std::string against_hold(const signal::DataQuality& quality) {
  const std::optional<double> factor = quality.compression_factor;
  if (!factor || *factor >= kLeastHold) return {};
  return "pv is renewed every " + number(*factor) + " samples on average";
}

std::string against_quantisation(const signal::DataQuality& quality) {
  const std::optional<double> factor = quality.quantisation_factor;
  if (!factor || *factor >= kFineGrid) return {};
  return "the grid of pv is " + number(*factor) + " of its standard deviation";
}

}  // namespace

std::string contradiction_of(const model::Step& step, const Case& loop) {
  switch (step.effect) {
    case model::EffectKind::valve_stiction:
    case model::EffectKind::valve_deadband:
      return against_valve(step, loop);
    case model::EffectKind::sensor_hold:
      return against_hold(loop.evidence.data_quality);
    case model::EffectKind::sensor_quantisation:
      return against_quantisation(loop.evidence.data_quality);
    default:
      return {};
  }
}

BelievedExplanation believed(const Case& loop) {
  BelievedExplanation result{*loop.evidence.model, {}};
  std::vector<model::Step> kept;
  for (model::Step& step : result.explanation.steps) {
    if (explains_the_cycle(step, loop.evidence)) {
      step.cycles_as_if_stuck = false;
      result.doubts.emplace_back(
          "Play makes a level loop cycle by itself, and leaves nothing that a slip would have "
          "left.");
    }
    const std::string fact = contradiction_of(step, loop);
    if (fact.empty()) {
      kept.push_back(std::move(step));
    } else {
      result.doubts.push_back("The model took in " + std::string(model::name(step.effect)) +
                              ", but " + fact + ": not believed.");
    }
  }
  result.explanation.steps = std::move(kept);
  const std::string& doubt = result.explanation.process_doubt;
  if (!doubt.empty()) result.doubts.push_back(doubt);
  return result;
}

}  // namespace loopscope::core::diagnosis
