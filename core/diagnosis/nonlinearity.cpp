#include "core/diagnosis/nonlinearity.hpp"

#include <algorithm>

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Segments of the paper's records: (4096 - 64) / 32 + 1.
constexpr double kPaperSegments = 127.0;

std::string peak_text(const hos::Result& hos) {
  if (hos.peaks.empty() || hos.published.linear) return {};
  const hos::Peak& peak = hos.peaks.front();
  return ", strongest at the bifrequency (" + number(peak.f1) + ", " + number(peak.f2) +
         ") cycles per sample";
}

std::string opening(bool found, const hos::Result& hos) {
  if (!found) return "No quadratic coupling found: ";
  return hos.peaks.empty() ? "Skewed or coupled, without a bifrequency that stands out: "
                           : "Quadratic coupling: ";
}

}  // namespace

double ngi_limit(std::size_t segments, const hos::Settings& settings) {
  const double shortage = kPaperSegments / static_cast<double>(std::max<std::size_t>(segments, 1));
  return settings.ngi_threshold * std::max(1.0, shortage);
}

NonlinearityFinding judge_nonlinearity(const hos::Result& hos, const hos::Settings& settings) {
  const double limit = ngi_limit(hos.segments, settings);
  NonlinearityFinding finding;
  finding.strength = hos.ngi / limit;
  finding.found = hos.ngi > limit && hos.nli > settings.nli_threshold;
  const std::string indices = "NGI " + number(hos.ngi) + " (limit " + number(limit) + " for " +
                              std::to_string(hos.segments) + " segments), NLI " + number(hos.nli);
  finding.reason = opening(finding.found, hos) + indices + peak_text(hos) + ".";
  return finding;
}

}  // namespace loopscope::core::diagnosis
