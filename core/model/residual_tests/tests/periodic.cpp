#include "core/model/residual_tests/tests/periodic.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/residual_tests/statistics/spectral_lines.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

struct SeenLine {
  SpectralLine line;
  bool in_pv = false;
};

/// Two lines closer than this many cycles per record are one.
constexpr double kSameCycles = 1.5;

bool same(const SpectralLine& a, const SpectralLine& b, double samples) {
  return std::abs(samples / a.period_samples - samples / b.period_samples) < kSameCycles;
}

/// The lines of both, each once, strongest first.
std::vector<SeenLine> merged(const LineSearch& residual, const LineSearch& pv, double samples) {
  std::vector<SeenLine> lines;
  for (const SpectralLine& line : pv.lines) lines.push_back({line, true});
  for (const SpectralLine& line : residual.lines) {
    const auto match = std::find_if(lines.begin(), lines.end(), [&](const SeenLine& other) {
      return same(other.line, line, samples);
    });
    if (match == lines.end()) {
      lines.push_back({line, false});
    } else if (line.p < match->line.p) {
      match->line.p = line.p;
      match->line.period_samples = line.period_samples;
    }
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const SeenLine& a, const SeenLine& b) { return a.line.p < b.line.p; });
  if (lines.size() > kMostLines) lines.resize(kMostLines);
  return lines;
}

std::string words_of(const SeenLine& line, double sample_interval_s) {
  return "period " + text::duration(line.line.period_samples * sample_interval_s) + " (" +
         text::number(line.line.period_samples) + " samples), amplitude " +
         text::units_of_pv(line.line.amplitude) + " in " + (line.in_pv ? "pv" : "the residual");
}

}  // namespace

TestOutcome test_periodic(const ResidualContext& context) {
  const LineSearch residual = find_lines(context.view.innovation);
  const LineSearch pv = find_lines(
      context.view.pv_undisturbed.empty() ? context.view.pv : context.view.pv_undisturbed);
  TestOutcome answer{{"periodic", std::min(1.0, 2.0 * std::min(residual.p, pv.p)), {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  const auto samples = static_cast<double>(context.view.pv.size());
  const std::vector<SeenLine> lines = merged(residual, pv, samples);
  answer.question.statement =
      lines.size() == 1 ? "A line in the spectrum: " : "Lines in the spectrum: ";
  for (const SeenLine& line : lines) {
    if (&line != &lines.front()) answer.question.statement += "; ";
    answer.question.statement += words_of(line, context.view.sample_interval_s);
    Nomination nomination{.effect = EffectKind::external_oscillation,
                          .p = line.line.p,
                          .period_samples = line.line.period_samples};
    if (line.in_pv) nomination.amplitude = line.line.amplitude;
    answer.nominations.push_back(nomination);
  }
  answer.question.statement += ".";
  return answer;
}

}  // namespace loopscope::core::model
