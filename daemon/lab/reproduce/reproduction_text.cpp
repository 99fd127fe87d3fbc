#include "daemon/lab/reproduce/reproduction_text.hpp"

#include <fmt/format.h>

#include "core/hos/analyse.hpp"
#include "core/text/counted.hpp"
#include "daemon/lab/reproduce/industrial_case.hpp"

namespace loopscope::daemon {

namespace {

std::string_view words(Agreement agreement) {
  switch (agreement) {
    case Agreement::met:
      return "met";
    case Agreement::in_range:
      return "within all seeds";
    case Agreement::not_met:
      break;
  }
  return "NOT met";
}

std::string figure_line(std::string_view label, const PaperFigure& paper, const Spread& ours) {
  const std::string measured =
      fmt::format("{:8.4f} [{:8.4f} .. {:8.4f}]", ours.median, ours.p10, ours.p90);
  if (!paper.value) return fmt::format("  {:<12}{:>9}   {}\n", label, "-", measured);
  const Agreement agreement = agreement_of(*paper.value, ours);
  std::string line =
      fmt::format("  {:<12}{:>9.4f}   {}   {}\n", label, *paper.value, measured, words(agreement));
  if (agreement != Agreement::met && !paper.obstacle.empty()) {
    line += fmt::format("{:14}why: {}\n", "", paper.obstacle);
  }
  return line;
}

std::string decision_line(const Example& example, const Measurement& measurement) {
  const bool gaussian = example.decision == PaperDecision::gaussian;
  return fmt::format("  {:<12}{:>9}   the published rule decides so in {:.0f} % of the seeds\n",
                     "decision", gaussian ? "Gaussian" : "nonlinear",
                     100.0 * measurement.decision_share);
}

std::string peak_lines(const Measurement& measurement) {
  std::string text;
  for (const PeakShare& peak : measurement.peaks) {
    text += fmt::format("  {:<9}({:.2f}, {:.2f})   found in {:.0f} % of the seeds{}\n", "peak",
                        peak.peak.f1, peak.peak.f2, 100.0 * peak.share,
                        peak.in_principal_domain ? "" : " (outside the principal domain)");
  }
  if (!measurement.peaks.empty() && measurement.peak_seeds > 0.0) {
    text += fmt::format("  {:<24}maximum at ({:.3f}, {:.3f}), median over the seeds\n", "",
                        measurement.max_f1.median, measurement.max_f2.median);
  }
  return text;
}

std::string loop_lines(const Example& example, const Measurement& measurement) {
  if (!measurement.verdict) return {};
  return figure_line("error std", {}, measurement.error_std) +
         fmt::format("  {:<24}{} in {:.0f} % of the seeds (the paper's cause: {})\n", "our verdict",
                     measurement.verdict->code, 100.0 * measurement.verdict->share,
                     example.paper_cause);
}

std::string example_text(const MeasuredExample& measured) {
  const auto& [example, measurement] = measured;
  std::string text = fmt::format("{} {}\n", example.section, example.title);
  text += figure_line("NGI", example.ngi, measurement.ngi);
  text += figure_line("NLI", example.nli, measurement.nli);
  text += decision_line(example, measurement);
  text += peak_lines(measurement);
  text += loop_lines(example, measurement);
  if (!example.remark.empty()) text += fmt::format("  note: {}\n", example.remark);
  return text + '\n';
}

std::string industrial_text() {
  std::string text = "Section 6: industrial cases. Their data are not public: no figure of ours.\n";
  for (const IndustrialCase& one : industrial_cases()) {
    text += fmt::format("{:<6} {:<38} NGI {:.4f}  NLI {:.3f}  {}\n{:7}{}\n", one.section, one.title,
                        one.ngi, one.nli, one.paper_cause, "", one.answer);
  }
  return text;
}

}  // namespace

std::string reproduction_text(const Reproduction& reproduction) {
  std::string text = fmt::format(
      "Examples of sections 4 and 5 over {}: the paper's figure, our median [10th .. 90th\n"
      "percentile]. met: the paper's figure lies between those percentiles; within all seeds:\n"
      "between our smallest and largest.\n\n",
      core::text::counted(reproduction.seeds, "seed", "seeds"));
  for (const MeasuredExample& measured : reproduction.examples) text += example_text(measured);
  return text + industrial_text();
}

}  // namespace loopscope::daemon
