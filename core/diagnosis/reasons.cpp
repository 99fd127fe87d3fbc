#include "core/diagnosis/reasons.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/loop_state.hpp"
#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/valve_words.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// "S 4.2 %, J 1.1 %, law kano"
std::string parameters_text(const model::Step& step) {
  std::string text;
  const auto add = [&text](std::string_view part) {
    if (!text.empty()) text += ", ";
    text += part;
  };
  for (const model::Parameter& parameter : step.parameters) {
    add(parameter.name);
    text.append(" ").append(text::number(parameter.value));
    if (!parameter.unit.empty()) text.append(" ").append(parameter.unit);
  }
  if (!step.law.empty()) {
    add("law ");
    text += step.law;
  }
  return text;
}

std::string statement_of(const model::Step& step) {
  if (!step.statement.empty()) return step.statement;
  const std::string parameters = parameters_text(step);
  std::string text = "The model includes ";
  text += text::code_words(model::name(step.effect));
  if (!parameters.empty()) text.append(" (").append(parameters).append(")");
  return text + ".";
}

bool is_tuning(VerdictCode code) {
  return catalogue_entry(code).blames == plant::Fault::tuning;
}

/// What would show where the nonlinearity is.
std::string record_more(const Evidence& evidence) {
  if (!op_speaks(evidence)) return "Record the controller output (op), then analyse again.";
  if (evidence.shape.mv_op_width)
    return "Do a stroke test; compare pv with the valve position at several levels.";
  return std::string(catalogue_entry(VerdictCode::nonlinear_unexplained).action);
}

/// A person reads so many; the rest is in the figures.
constexpr std::size_t kMostParts = 4;
/// Odds changed by less than a tenth are not worth a line.
constexpr double kLeastWeight = 0.1;

std::string measured_text(const Part& part) {
  return figure_text(all_figures()[*part.figure], *part.value);
}

std::string others_text(const Part& part) {
  const std::string chance = text::percent(part.value.value_or(0.0));
  if (part.other == VerdictCode::nonlinear_unexplained)
    return "some nonlinearity of valve or process: " + chance;
  return "other causes together by their own figures: " + chance + ", most likely " +
         text::code_words(name(part.other));
}

/// " (odds times 3.1)".
std::string odds_text(double weight) {
  return std::string(weight > 0.0 ? " (odds times " : " (odds divided by ") +
         text::number(std::exp(std::abs(weight))) + ")";
}

/// "op repeats its half cycle: 93 % (odds times 3.1)".
std::string part_text(const Part& part) {
  return (part.figure ? measured_text(part) : others_text(part)) + odds_text(part.weight);
}

std::string oscillation_text(const loop::Oscillation& oscillation) {
  return "Oscillation of period " + text::duration(oscillation.period_s.value_or(0.0)) +
         ", regularity " + text::number(oscillation.regularity.value_or(0.0)) + ", persistence " +
         text::number(oscillation.persistence.value_or(0.0)) + ".";
}

std::string position_text(const loop::Shape& shape) {
  return "The mv-op plot is " + text::number(*shape.mv_op_width) + " % wide, mv jumps by " +
         text::number(shape.mv_slip_jump.value_or(0.0)) +
         " % when it leaves rest; mv stands still in " +
         text::percent(shape.mv_stuck_fraction.value_or(0.0)) +
         " of the samples in which op moves.";
}

void add_model(const model::Explanation& model, std::vector<std::string>& reasons) {
  for (const model::Step& step : model.steps) {
    const bool believed = model.excited || model::is_seen_without_op(step.effect);
    reasons.push_back(
        believed ? step_text(step)
                 : "The model fitted " + text::code_words(model::name(step.effect)) +
                       ", but the controller output moves too little to confirm it: rejected.");
  }
  if (!model.excited) {
    reasons.push_back("The process from op to pv could not be identified from these data. " +
                      model.excitation);
    return;
  }
  reasons.push_back((model.steps.empty() ? "A linear loop model is sufficient. " : "") +
                    unexplained_text(model));
  if (!model.process_doubt.empty()) reasons.push_back(model.process_doubt);
  if (model.closed_loop) reasons.push_back(closed_loop_text(*model.closed_loop));
}

void add_data(const Evidence& evidence, std::vector<std::string>& reasons) {
  // A state has said it.
  const bool held = state_of(evidence) == LoopState::held_at_limit || evidence.still.has_value();
  if (!op_speaks(evidence) && !held) {
    reasons.emplace_back(
        "op does not move or is not recorded: controller and valve cannot be "
        "judged.");
  }
  if (has_flag(evidence, "pv_quantised")) {
    reasons.push_back("pv moves in steps of " +
                      text::number(evidence.data_quality.quantisation_factor.value_or(0.0)) +
                      " of its standard deviation.");
  }
  if (has_flag(evidence, "pv_held")) {
    reasons.push_back("pv is renewed only every " +
                      text::number(evidence.data_quality.compression_factor.value_or(1.0)) +
                      " samples on average.");
  }
  const std::string at_limit = output_at_limit_text(evidence);
  if (!at_limit.empty() && !held) reasons.push_back(at_limit);
  if (!evidence.op_range_doubt.empty())
    reasons.push_back(
        "The range of op in the catalogue cannot be right: " + evidence.op_range_doubt + ".");
}

}  // namespace

std::string step_text(const model::Step& step) {
  return statement_of(step) + " One-step prediction error on held-out samples: " +
         text::number(step.holdout_error_before) + " -> " + text::number(step.holdout_error_after) +
         " (evidence " + text::number(step.evidence) + ", p " + text::p_text(step.p) + ").";
}

std::string output_at_limit_text(const Evidence& evidence) {
  constexpr double kShownAsPercent = 0.005;  // less would read 0 %
  const double share = evidence.data_quality.saturated_fraction.value_or(0.0);
  if (share < kShownAsPercent) return {};
  return "The controller output is at a limit of its range in " + text::percent(share) +
         " of the samples.";
}

std::string unexplained_text(const model::Explanation& explanation) {
  const model::Unexplained& rest = explanation.unexplained;
  std::string text = left_text(explanation);
  if (!rest.statement.empty()) text += " " + rest.statement;
  for (const model::Question& question : explanation.questions) {
    const bool said = rest.statement.find(question.statement) != std::string::npos;
    if (!said) text += " " + question.statement;
  }
  return text;
}

std::string closed_loop_text(const model::ClosedLoop& loop) {
  const std::string start = "Closed loop by the fitted model and the recorded controller: ";
  const std::string period = loop.period_s > 0.0 ? ", period " + text::duration(loop.period_s)
                                                 : std::string(", no oscillation");
  if (!std::isfinite(loop.peak_sensitivity)) return start + "unstable" + period + ".";
  return start + "peak sensitivity " + text::number(loop.peak_sensitivity) + ", damping " +
         text::number(loop.damping) + period + ", settles in " + text::duration(loop.settling_s) +
         ".";
}

std::string action_for(VerdictCode code, const Evidence& evidence, const Causes& causes,
                       double line) {
  if (code == VerdictCode::nonlinear_unexplained) return record_more(evidence);
  std::string own = code == VerdictCode::valve_stiction ? stroke_test_action(evidence)
                                                        : std::string(catalogue_entry(code).action);
  // The words for saturation say so already.
  if (code == VerdictCode::valve_saturation) return own;
  if (catalogue_entry(code).withholds_tuning) return own.append(kTuningWaits);
  if (!is_tuning(code)) return own;
  const auto first = std::ranges::find_if(causes, [&](const WeighedCause& cause) {
    return catalogue_entry(cause.code).withholds_tuning && cause.probability() >= line;
  });
  return first == causes.end() ? own : action_for(first->code, evidence, causes, line);
}

CauseReport report_of(const WeighedCause& cause) {
  CauseReport report{cause.code, cause.probability(), cause.prior, {}, {}, cause.evidence};
  double unknown = 0.0;
  for (const Part& part : cause.parts) {
    const bool computed = !part.figure || part.value;
    if (!computed) unknown += part.weight;
    if (!computed || std::abs(part.weight) < kLeastWeight) continue;
    std::vector<std::string>& side = part.weight > 0.0 ? report.in_favour : report.against;
    if (side.size() < kMostParts) side.push_back(part_text(part));
  }
  if (std::abs(unknown) >= kLeastWeight) {
    std::vector<std::string>& side = unknown > 0.0 ? report.in_favour : report.against;
    side.push_back("some figures cannot be measured in this window" + odds_text(unknown));
  }
  return report;
}

std::vector<std::string> findings(const Evidence& evidence,
                                  const NonlinearityFinding& nonlinearity) {
  std::vector<std::string> reasons;
  if (evidence.model) add_model(*evidence.model, reasons);
  add_data(evidence, reasons);
  if (evidence.shape.mv_op_width) reasons.push_back(position_text(evidence.shape));
  reasons.push_back(nonlinearity.reason);
  if (oscillates(evidence)) reasons.push_back(oscillation_text(evidence.oscillation));
  return reasons;
}

std::vector<std::string> reasons_for(const CauseReport& cause, const Evidence& evidence,
                                     const NonlinearityFinding& nonlinearity) {
  std::vector<std::string> reasons;
  for (const std::string& part : cause.in_favour) reasons.push_back("For: " + part + ".");
  for (const std::string& part : cause.against) reasons.push_back("Against: " + part + ".");
  for (std::string& finding : findings(evidence, nonlinearity))
    reasons.push_back(std::move(finding));
  return reasons;
}

}  // namespace loopscope::core::diagnosis
