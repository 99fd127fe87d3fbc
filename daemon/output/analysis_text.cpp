#include "daemon/output/analysis_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "daemon/output/model_text.hpp"
#include "daemon/output/text_line.hpp"

namespace loopscope::daemon {
namespace {

std::string verdict_text(const core::diagnosis::Verdict& verdict) {
  std::string text =
      fmt::format("  {} (confidence {:.2f}): {}\n", core::diagnosis::name(verdict.code),
                  verdict.confidence, verdict.summary);
  for (const std::string& reason : verdict.reasons) text += "    - " + reason + "\n";
  return text + "  What to do: " + verdict.action + "\n";
}

std::string hos_text(const core::hos::Result& hos) {
  return fmt::format(
      "NGI {:.4f}, NLI {:.4f} over {} segments and {} bifrequencies; published "
      "rule: {}, {}",
      hos.ngi, hos.nli, hos.segments, hos.bifrequencies,
      hos.published.gaussian ? "Gaussian" : "non-Gaussian",
      hos.published.linear ? "no nonlinearity shown" : "nonlinear");
}

std::string peaks_text(const core::hos::Result& hos, double sample_interval_s) {
  std::string text;
  for (const core::hos::Peak& peak : hos.peaks) {
    text +=
        text_line("peak", fmt::format("bic2 {:.3f} at ({:.4f}, {:.4f}) cycles per sample: periods "
                                      "{:.4g} s and {:.4g} s",
                                      peak.bic2, peak.f1, peak.f2, sample_interval_s / peak.f1,
                                      sample_interval_s / peak.f2));
  }
  return text;
}

/// Without the published rule: it does not know that these segments overlap by three quarters.
std::string slow_look_text(const core::hos::SlowLook& look, double sample_interval_s) {
  std::string text = text_line(
      "decimated",
      fmt::format("NGI {:.4f}, NLI {:.4f}, p {} over {} segments of {} samples "
                  "decimated by {}",
                  look.result.ngi, look.result.nli, p_figure_text(look.result.nonlinear_p),
                  look.result.segments, look.samples, look.decimation));
  return text + peaks_text(look.result, static_cast<double>(look.decimation) * sample_interval_s);
}

std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.3g} %", 100.0 * *share) : figure_text(share);
}

/// In the unit of pv, whichever that is.
std::string size_text(const std::optional<double>& size) {
  const std::string text = figure_text(size);
  if (!size) return text;
  return text + (text == "1" ? " unit of pv" : " units of pv");
}

/// Of one that is not there the figures are those of what comes nearest to one.
std::string oscillation_text(const core::loop::Oscillation& oscillation) {
  if (!oscillation.present && !oscillation.period_s) return "none found";
  return fmt::format("{} period {} s, regularity {}, persistence {}, amplitude {}",
                     oscillation.present ? "present;" : "none found; best candidate:",
                     figure_text(oscillation.period_s), figure_text(oscillation.regularity),
                     figure_text(oscillation.persistence), size_text(oscillation.amplitude));
}

std::string performance_text(const core::loop::Performance& performance) {
  return fmt::format(
      "Harris {} to {}; error std {}; valve travel {} %/h, {} reversals/h; op at a "
      "limit {}",
      figure_text(performance.harris_low), figure_text(performance.harris_high),
      size_text(performance.error_std), figure_text(performance.valve_travel_per_h),
      figure_text(performance.reversals_per_h), percent_text(performance.at_limit_fraction));
}

std::string shape_text(const core::loop::Shape& shape) {
  return fmt::format("shape index {}, Horch dtau {} drho {}, ellipse {} %, mv-op width {} %",
                     figure_text(shape.shape_index), figure_text(shape.horch_dtau),
                     figure_text(shape.horch_drho), figure_text(shape.ellipse_stiction),
                     figure_text(shape.mv_op_width));
}

}  // namespace

std::string analysis_text(const std::string& title, double sample_interval_s,
                          const core::Diagnosis& diagnosis) {
  const core::Evidence& evidence = diagnosis.evidence;
  std::string text = title + "\n" + verdict_text(diagnosis.verdict) + "\n";
  if (evidence.model) text += model_text(*evidence.model);
  if (evidence.hos) {
    text += text_line("statistics", hos_text(*evidence.hos));
    text += peaks_text(*evidence.hos, sample_interval_s);
  }
  if (evidence.hos_slow) text += slow_look_text(*evidence.hos_slow, sample_interval_s);
  text += text_line("oscillation", oscillation_text(evidence.oscillation));
  text += text_line("performance", performance_text(evidence.performance));
  text += text_line("shape", shape_text(evidence.shape));
  const core::signal::DataQuality& quality = evidence.data_quality;
  text +=
      text_line("data", fmt::format("missing {}, flags: {}", percent_text(quality.missing_fraction),
                                    quality.flags.empty()
                                        ? "none"
                                        : fmt::format("{}", fmt::join(quality.flags, ", "))));
  return text;
}

}  // namespace loopscope::daemon
