#include "core/diagnosis/loop_state.hpp"

#include <cmath>

#include "core/diagnosis/evidence/structure.hpp"
#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

using signal::NotActing;

constexpr double kShown = 0.9;
constexpr double kFalselyShown = 1e-3;

std::string samples_text(std::size_t samples, double interval_s) {
  return text::counted(samples, "sample", "samples") + " (" +
         text::duration(static_cast<double>(samples) * interval_s) + ")";
}

std::string output_text(double value, const Evidence& evidence) {
  return text::number(value) + (evidence.op_in_percent ? " %" : "");
}

std::string still_text(const signal::StandStill& still, const Evidence& evidence) {
  std::string text = std::string(still.to_the_end ? "pv stands still at " : "pv stood still at ") +
                     text::number(still.run.value) + " for " +
                     samples_text(still.run.samples, evidence.interval_s);
  if (still.whole)
    text += ", all that was read,";
  else if (still.to_the_end)
    text += ", up to the window's end,";
  else if (still.run.end() < evidence.samples)
    text += ", until " + samples_text(evidence.samples - still.run.end(), evidence.interval_s) +
            " before the window's end,";
  if (still.op_moves)
    text += " while op goes from " + output_text(still.op_low, evidence) + " to " +
            output_text(still.op_high, evidence);
  if (still.error_lasts)
    text += std::string(still.op_moves ? " and" : " while") + " the error stays at " +
            text::number(still.error);
  return text + ".";
}

std::string limit_text(const Evidence& evidence) {
  const std::string text = "op is at an end of its range in " +
                           text::percent(evidence.control.at_limit_fraction.value_or(0.0)) +
                           " of the samples and the error does not go away";
  const std::optional<double> end = evidence.control.wound_up_percent;
  return text + (end ? ": the controller has wound up to " + text::number(*end) + " %." : ".");
}

std::string lost_text(const Evidence& evidence) {
  const signal::ControlState& control = evidence.control;
  const std::string why = control.reason == NotActing::mode
                              ? "The controller was in manual, tracking or out of service"
                              : "The controller output stood still";
  std::string text =
      why + " for " + text::percent(1.0 - control.acting_fraction.value_or(0.0)) + " of the window";
  if (control.lost_at && *control.lost_at < evidence.samples)
    text += ", and throughout the last " +
            samples_text(evidence.samples - *control.lost_at, evidence.interval_s);
  return text + ".";
}

bool has_wound_up(const Evidence& evidence) {
  return evidence.still->to_the_end && evidence.control.wound_up_percent.has_value();
}

}  // namespace

LoopState state_of(const Evidence& evidence) {
  if (!evidence.data_quality.enough) return LoopState::none;
  if (evidence.still) return LoopState::stands_still;
  const bool by_hand =
      !evidence.control.controlling() && evidence.control.reason == NotActing::mode;
  if (evidence.control.held_at_limit && !by_hand) return LoopState::held_at_limit;
  return evidence.control.controlling() ? LoopState::none : LoopState::not_controlling;
}

std::vector<std::string> state_text(LoopState state, const Evidence& evidence) {
  std::vector<std::string> text;
  if (state == LoopState::stands_still) text.push_back(still_text(*evidence.still, evidence));
  if (state == LoopState::not_controlling) text.push_back(lost_text(evidence));
  const bool wound_up = state == LoopState::stands_still && has_wound_up(evidence);
  if (state == LoopState::held_at_limit || wound_up) text.push_back(limit_text(evidence));
  return text;
}

std::string frozen_summary(const Evidence& evidence) {
  if (!evidence.still->to_the_end) return "The measurement stood still for a while.";
  if (!has_wound_up(evidence)) return "The measurement stands still.";
  return "The measurement stands still, and the controller has wound up to " +
         text::number(*evidence.control.wound_up_percent) + " %.";
}

std::string frozen_action() {
  return "Compare pv with a second measurement or the local gauge; check transmitter, impulse "
         "lines and the line to the archive. Where the process itself stands (pump off, line "
         "shut), take the loop out of service.";
}

std::string not_controlling_summary(const Evidence& evidence) {
  if (!evidence.control.lost_at) return "For most of the window no controller acted on the loop.";
  return evidence.control.reason == NotActing::mode
             ? "No controller acts on the loop: manual, tracking or out of service."
             : "No controller acts on the loop: its output is constant.";
}

std::string not_controlling_action(const Evidence& evidence) {
  if (!evidence.control.lost_at)
    return "The controller acts again: wait for a window with it in service.";
  const std::string meant = " If this is meant to last, disable the loop in the catalogue.";
  return evidence.control.reason == NotActing::mode
             ? "Ask operations why it is not in automatic." + meant
             : "Check the controller's mode (manual, tracking, out of service) and the output's "
               "tag." +
                   meant;
}

double state_evidence() {
  return std::log(kShown / kFalselyShown);
}

}  // namespace loopscope::core::diagnosis
