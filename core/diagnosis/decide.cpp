#include "core/diagnosis/decide.hpp"

#include <algorithm>
#include <utility>

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/model_verdict.hpp"
#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/nonlinear_verdict.hpp"
#include "core/diagnosis/uncoupled_verdict.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

/// op at a limit for more of the window than this is a finding of its own (notes on 141 loops).
constexpr double kSaturatedFraction = 0.05;
/// Findings on fewer than 32 segments weigh less.
constexpr double kShortRecord = 0.75;

Verdict saturated(const Evidence& evidence) {
  const double fraction = *evidence.data_quality.saturated_fraction;
  return make(VerdictCode::valve_saturation, 0.5 + 0.4 * std::min(1.0, fraction / 0.5),
              {"op is at a limit of its range in " + percent(fraction) + " of the samples."});
}

/// The valve position was recorded: what it shows is measured, whatever the bispectrum says.
Verdict faulty_position(const Case& loop) {
  const bool sticks = loop.valve.kind == Kind::sticks;
  return make(sticks ? VerdictCode::valve_stiction : VerdictCode::valve_deadband, 0.9,
              reasons_of(loop));
}

Verdict insufficient(const Evidence& evidence) {
  return make(VerdictCode::insufficient_data, 1.0, {evidence.data_quality.reason + "."});
}

Verdict unrefreshed(const Evidence& evidence) {
  const double factor = evidence.data_quality.compression_factor.value_or(1.0);
  return make(VerdictCode::sensor_fault, 0.7,
              {has_flag(evidence, "pv_frozen")
                   ? "pv stands still for hundreds of samples while op moves."
                   : "pv is renewed only every " + number(factor) + " samples on average."});
}

Verdict not_in_command() {
  Verdict verdict = make(VerdictCode::unexplained, 0.6,
                         {"pv stays many standard deviations away from its setpoint: the "
                          "controller is not in command, or has no integral action."});
  verdict.action =
      "Check whether an override or another controller holds the valve; if that is "
      "meant, disable the loop in the catalogue.";
  return verdict;
}

/// What the model found beside a fact, for the record.
Verdict with_effects(Verdict verdict, const Evidence& evidence) {
  if (!evidence.model || !evidence.model->excited) return verdict;
  for (const model::Step& step : evidence.model->steps) verdict.reasons.push_back(step_text(step));
  return verdict;
}

Verdict with_excitation(Verdict verdict, const Evidence& evidence) {
  if (evidence.model && !evidence.model->excitation.empty()) {
    verdict.reasons.push_back("Of the way from op to pv the model claims nothing: " +
                              evidence.model->excitation);
  }
  return verdict;
}

/// Tuning and health are what is said where nothing else is known.
bool knows_no_cause(VerdictCode code) {
  using enum VerdictCode;
  return code == healthy || code == sluggish_tuning || code == tight_tuning || code == unexplained;
}

/// By the statistics, unless they know less than what the model saw come from outside.
Verdict without_model(const Case& loop) {
  Verdict verdict = coupling_leads(loop) ? nonlinear_verdict(loop) : uncoupled_verdict(loop);
  if (!loop.evidence.model || !knows_no_cause(verdict.code)) return verdict;
  return outside_verdict(loop).value_or(std::move(verdict));
}

Verdict choose(const Evidence& evidence, const hos::Settings& settings) {
  if (!evidence.data_quality.usable || !evidence.hos) return insufficient(evidence);
  if (has_flag(evidence, "pv_frozen") || has_flag(evidence, "pv_held")) {
    return unrefreshed(evidence);
  }
  if (evidence.data_quality.saturated_fraction.value_or(0.0) > kSaturatedFraction) {
    return with_effects(saturated(evidence), evidence);
  }
  if (has_flag(evidence, "sp_not_followed")) return not_in_command();
  const Case loop{evidence, judge_nonlinearity(evidence, settings), judge_valve(evidence)};
  const bool faulty = loop.valve.kind == Kind::sticks || loop.valve.kind == Kind::dead_band;
  if (loop.valve.measured && faulty) return with_effects(faulty_position(loop), evidence);
  if (evidence.model && evidence.model->excited) return model_verdict(loop);
  return with_excitation(without_model(loop), evidence);
}

}  // namespace

Verdict decide(const Evidence& evidence, const hos::Settings& settings) {
  Verdict verdict = choose(evidence, settings);
  if (has_flag(evidence, "short") && verdict.code != VerdictCode::insufficient_data) {
    verdict.confidence *= kShortRecord;
    verdict.reasons.emplace_back("Short record: fewer than 32 segments.");
  }
  if (!evidence.data_quality.stretch.empty()) {
    verdict.reasons.push_back("The loop changed within the window: the tests see only " +
                              evidence.data_quality.stretch + ".");
  }
  return verdict;
}

}  // namespace loopscope::core::diagnosis
