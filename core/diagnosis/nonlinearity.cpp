#include "core/diagnosis/nonlinearity.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/case.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Nobody sends a fitter for p = 0.04; one loop in ten thousand linear ones shows this.
constexpr double kConvincing = 1e-4;

std::string coupling_text(hos::Coupling coupling) {
  switch (coupling) {
    case hos::Coupling::quadratic:
      return "Quadratic coupling";
    case hos::Coupling::cubic:
      return "Cubic coupling (odd-symmetric, as of a square or triangular wave)";
    case hos::Coupling::both:
      return "Quadratic and cubic coupling";
    case hos::Coupling::none_found:
      break;
  }
  return "No quadratic or cubic coupling found";
}

std::string p_text(const hos::Result& hos) {
  std::string text = "p = " + number(hos.nonlinear_p.value_or(1.0)) + " (NGI " +
                     number(hos.ngi_p.value_or(1.0)) + ", NLI " + number(hos.nli_p.value_or(1.0));
  if (hos.cubic_p) text += ", cubic " + number(*hos.cubic_p);
  return text + ")";
}

std::string published_text(const hos::Result& hos) {
  return "; published figures: NGI " + number(hos.ngi) + ", NLI " + number(hos.nli) + " on " +
         std::to_string(hos.segments) + " segments";
}

/// The strongest peak that is significant by itself.
std::string peak_text(const hos::Result& hos, double alpha) {
  const auto peak = std::ranges::find_if(
      hos.peaks, [alpha](const hos::Peak& found) { return found.p.value_or(1.0) <= alpha; });
  if (hos.coupling == hos::Coupling::none_found || peak == hos.peaks.end()) return {};
  return ", strongest at the bifrequency (" + number(peak->f1) + ", " + number(peak->f2) +
         ") cycles per sample";
}

std::string slow_text(const hos::SlowLook& slow) {
  return " On every " + std::to_string(slow.decimation) +
         "th sample, to fit the slow oscillation: " + coupling_text(slow.result.coupling) + ", " +
         p_text(slow.result) + ".";
}

/// A setpoint that moves too often to be left out makes the error of a linear loop non-Gaussian.
/// What a loop model leaves has that taken out.
bool needs_residual(const Evidence& evidence) {
  return evidence.model && has_flag(evidence, "sp_moving");
}

double residual_p(const model::Explanation& explanation) {
  const auto asked = std::ranges::find_if(
      explanation.questions, [](const model::Question& q) { return q.name == "nonlinear"; });
  return asked == explanation.questions.end() ? 1.0 : asked->p;
}

double held_by_residual(const Evidence& evidence, double p) {
  return needs_residual(evidence) ? std::max(p, residual_p(*evidence.model)) : p;
}

std::string residual_text(const Evidence& evidence) {
  if (!needs_residual(evidence)) return {};
  return " The setpoint moves too often to be left out, so that coupling counts only where what "
         "the "
         "loop model leaves shows it as well: p = " +
         number(residual_p(*evidence.model)) + ".";
}

std::string refusal_text(const Evidence& evidence) {
  std::string text;
  for (const std::string& reason : evidence.data_quality.refusals) {
    text += (text.empty() ? "" : "; ") + reason;
  }
  return text.empty() ? "they have no p-value" : text;
}

}  // namespace

double nonlinear_p(const Evidence& evidence) {
  const double first = evidence.hos ? evidence.hos->nonlinear_p.value_or(1.0) : 1.0;
  if (!evidence.hos_slow || !evidence.hos_slow->result.nonlinear_p) return first;
  const double smaller = std::min(first, *evidence.hos_slow->result.nonlinear_p);
  return smaller * (2.0 - smaller);  // Sidak: 1 - (1 - p)^2
}

NonlinearityFinding judge_nonlinearity(const Evidence& evidence, const hos::Settings& settings) {
  const hos::Result& hos = *evidence.hos;
  NonlinearityFinding finding;
  if (!hos.nonlinear_p) {
    finding.reason = "The tests for nonlinearity were refused: " + refusal_text(evidence) + ".";
    return finding;
  }
  finding.p = held_by_residual(evidence, nonlinear_p(evidence));
  finding.found = finding.p <= settings.alpha;
  finding.belief = std::clamp(
      std::log(settings.alpha / finding.p) / std::log(settings.alpha / kConvincing), 0.0, 1.0);
  finding.reason = coupling_text(hos.coupling) + ": " + p_text(hos) +
                   peak_text(hos, settings.alpha) + published_text(hos) + ".";
  if (evidence.hos_slow) finding.reason += slow_text(*evidence.hos_slow);
  finding.reason += residual_text(evidence);
  return finding;
}

}  // namespace loopscope::core::diagnosis
