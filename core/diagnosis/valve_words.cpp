#include "core/diagnosis/valve_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// An output is hardly stepped by less, %.
constexpr double kLeastStep = 0.1;

/// The step that found friction or dead band and explains most; nullptr where there is none.
const model::Step* band_step(const Evidence& evidence) {
  if (!evidence.model || !evidence.model->excited) return nullptr;
  const model::Step* most = nullptr;
  for (const model::Step& step : evidence.model->steps) {
    const bool band = step.effect == model::EffectKind::valve_stiction ||
                      step.effect == model::EffectKind::valve_deadband;
    if (!band || step.parameters.empty()) continue;
    if (most == nullptr || model::explained_by(step) > model::explained_by(*most)) most = &step;
  }
  return most;
}

/// One significant digit.
double rounded(double value) {
  const double ten = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / ten) * ten;
}

/// What the figure adds to the log odds of the cause; 0 where it is none of its figures.
double weight_in(const Causes& causes, VerdictCode code, std::size_t figure) {
  const auto cause = std::ranges::find(causes, code, &WeighedCause::code);
  if (cause == causes.end()) return 0.0;
  const auto part = std::ranges::find_if(
      cause->parts, [&](const Part& one) { return one.figure && *one.figure == figure; });
  return part == cause->parts.end() ? 0.0 : part->weight;
}

/// That there is a band at all, which friction and dead band share.
bool speaks_for_either(const Figure& figure) {
  return figure.name.starts_with("step.") || figure.name.starts_with("asked.");
}

/// Odds as people say them instead of their logarithm: "odds that ...: 30 to 1".
std::string plain_figure(const Figure& figure, double value) {
  constexpr std::string_view kLog = "log ";
  if (!figure.words.starts_with(kLog)) return figure_text(figure, value);
  const std::string ratio = text::number(rounded(std::exp(std::abs(value))));
  return std::string(figure.words.substr(kLog.size())) + ": " +
         (value < 0.0 ? "1 to " + ratio : ratio + " to 1");
}

/// The figure that speaks most for stiction beside dead band, in words: "op repeats its half cycle:
/// 93 %"; empty where none was measured that does.
std::string what_weighed(const Causes& causes, const Evidence& evidence) {
  const std::vector<std::optional<double>> values = measure_figures(evidence);
  std::string words;
  double most = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double weight = weight_in(causes, VerdictCode::valve_stiction, k) -
                          weight_in(causes, VerdictCode::valve_deadband, k);
    if (!values[k] || weight <= most || speaks_for_either(all_figures()[k])) continue;
    most = weight;
    words = plain_figure(all_figures()[k], *values[k]);
  }
  return words;
}

}  // namespace

std::string valve_summary(VerdictCode code, const Evidence& evidence) {
  const model::Step* const step = band_step(evidence);
  if (code != VerdictCode::valve_stiction || step == nullptr ||
      step->effect != model::EffectKind::valve_deadband)
    return {};
  return "Hysteresis of the valve keeps the loop cycling: it sticks or has dead band, a stroke "
         "test tells which.";
}

std::string why_stiction(VerdictCode code, const Evidence& evidence, const Causes& alone,
                         double line) {
  if (valve_summary(code, evidence).empty()) return {};
  const double sticks = probability_in(alone, VerdictCode::valve_stiction);
  const double play = probability_in(alone, VerdictCode::valve_deadband);
  const std::string weighed = what_weighed(alone, evidence);
  const std::string both = "stiction (" + text::percent(sticks) + " probable) from dead band (" +
                           text::percent(play) + ")";
  if (play >= line || play >= sticks)
    return "This window can hardly tell " + both +
           (weighed.empty() ? "." : "; for stiction speaks most: " + weighed + ".");
  return "What tells " + both + ": " + (weighed.empty() ? "all figures together" : weighed) + ".";
}

std::string stroke_test_action(const Evidence& evidence) {
  const model::Step* const step = band_step(evidence);
  const double band = step == nullptr ? 0.0 : step->parameters.front().value;
  if (!evidence.op_in_percent || !(band > 0.0))
    return std::string(catalogue_entry(VerdictCode::valve_stiction).action);
  constexpr double kPart = 4.0;
  return "Check in the field: put the controller in manual, step the output by about " +
         text::number(std::max(rounded(band / kPart), kLeastStep)) +
         " % at a time (a quarter of the " + text::number(band) +
         " % found) and watch when the stem moves; then packing, actuator and positioner.";
}

}  // namespace loopscope::core::diagnosis
