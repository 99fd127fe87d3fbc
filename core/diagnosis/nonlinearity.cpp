#include "core/diagnosis/nonlinearity.hpp"

#include <algorithm>

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Segments of the paper's records: (4096 - 64) / 32 + 1.
constexpr double kPaperSegments = 127.0;

std::string peak_text(const hos::Result& hos) {
  if (hos.peaks.empty()) return {};
  const hos::Peak& peak = hos.peaks.front();
  return ", strongest at the bifrequency (" + number(peak.f1) + ", " + number(peak.f2) +
         ") cycles per sample";
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
  finding.reason = finding.found ? "Quadratic coupling: " + indices + peak_text(hos) + "."
                                 : "No quadratic coupling found: " + indices + ".";
  return finding;
}

}  // namespace loopscope::core::diagnosis
