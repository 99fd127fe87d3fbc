#include "core/diagnosis/evidence/nonlinearity.hpp"

#include <algorithm>

#include "core/diagnosis/evidence/structure.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

std::string coupling_text(hos::Coupling coupling) {
  switch (coupling) {
    case hos::Coupling::quadratic:
      return "Quadratic phase coupling";
    case hos::Coupling::cubic:
      return "Cubic phase coupling (third harmonic, as of a square or triangular wave)";
    case hos::Coupling::both:
      return "Quadratic and cubic phase coupling";
    case hos::Coupling::none_found:
    case hos::Coupling::too_short:
      break;
  }
  return "No quadratic or cubic phase coupling found";
}

/// Never by the names of the indices: those are no p-values, and stand in the same sentence.
std::string tests_text(const hos::Result& hos) {
  std::string text = text::p_equals(hos.nonlinear_p.value_or(1.0)) +
                     " (p by test: quadratic on average " + text::p_text(hos.ngi_p.value_or(1.0)) +
                     ", at single bifrequencies " + text::p_text(hos.nli_p.value_or(1.0));
  if (hos.cubic_p) text += ", cubic " + text::p_text(*hos.cubic_p);
  if (hos.innovation_p) text += ", innovations " + text::p_text(*hos.innovation_p);
  return text + ")";
}

std::string published_text(const hos::Result& hos) {
  return "; published indices NGI " + text::number(hos.ngi) + ", NLI " + text::number(hos.nli) +
         " on " + std::to_string(hos.segments) + " segments";
}

/// The strongest peak that is significant by itself.
std::string peak_text(const hos::Result& hos, double alpha) {
  const auto peak = std::ranges::find_if(
      hos.peaks, [alpha](const hos::Peak& found) { return found.p.value_or(1.0) <= alpha; });
  if (hos.nonlinear_p.value_or(1.0) > alpha || peak == hos.peaks.end()) return {};
  return ", strongest at the bifrequency (" + text::number(peak->f1) + ", " +
         text::number(peak->f2) + ") cycles per sample";
}

std::string slow_text(const hos::SlowLook& slow) {
  std::string coupling = coupling_text(slow.result.coupling);
  coupling.front() = static_cast<char>(coupling.front() - 'A' + 'a');
  return " On data decimated by " + std::to_string(slow.decimation) +
         " (slow oscillation): " + coupling + ", " + tests_text(slow.result) + ".";
}

std::string residual_text(const Evidence& evidence) {
  if (evidence.tested_on == TestedOn::error) return {};
  return " The setpoint moves too often for those samples to be excluded: the tests use the error "
         "less the loop's linear response to the setpoint.";
}

/// Noise that a linear loop passes on, said for itself.
std::string noise_text(const Evidence& evidence) {
  const hos::NoiseShape& noise = evidence.hos->noise.value_or(hos::NoiseShape{});
  const bool bursts = has_flag(evidence, "variance_changes");
  const bool outliers = has_flag(evidence, "heavy_tails");
  std::string text;
  if (bursts) {
    text += " The disturbance comes in bursts (" + text::p_equals(noise.variance_p) + ")";
    if (noise.loudest_size > 0) {
      text += ", longest or loudest from sample " + std::to_string(noise.loudest_first + 1) +
              " to " + std::to_string(noise.loudest_first + noise.loudest_size) + ", " +
              text::number(noise.loudest_ratio) + " times as strong as usual";
    }
    text += ".";
  }
  if (outliers) {
    text += " The disturbance has outliers (kurtosis " + text::number(3.0 + noise.excess_kurtosis) +
            " instead of 3, " + text::p_equals(noise.tails_p) + ").";
  }
  if (bursts && outliers) return text + " Neither counts as nonlinearity.";
  return text.empty() ? text : text + " This does not count as nonlinearity.";
}

std::string too_short_text(const Evidence& evidence) {
  if (evidence.samples_wanted == 0) return {};
  return " The record is too short for the tests to see whether the oscillation is nonlinear: " +
         std::to_string(evidence.samples_wanted) + " samples would do.";
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
  finding.p = nonlinear_p(evidence);
  finding.found = finding.p <= settings.alpha;
  finding.reason = coupling_text(hos.coupling) + ": " + tests_text(hos) +
                   peak_text(hos, settings.alpha) + published_text(hos) + ".";
  if (evidence.hos_slow) finding.reason += slow_text(*evidence.hos_slow);
  finding.reason += residual_text(evidence) + too_short_text(evidence);
  if (!finding.found) finding.reason += noise_text(evidence);
  return finding;
}

}  // namespace loopscope::core::diagnosis
