#include "core/plant/source_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/coupling/harmonic_test.hpp"
#include "core/hos/slow/decimate.hpp"
#include "core/hos/slow/period.hpp"
#include "core/plant/lead.hpp"
#include "core/plant/spectral_line.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::plant {
namespace {

/// Samples of a cycle at which three harmonics have room; core/hos looks at slow ones in the same
/// way.
constexpr double kSamplesACycle = 12.0;

/// A loop of less is shaken by something else for the most part.
constexpr double kFullStrength = 0.25;
/// A probability that people are told of.
constexpr double kWorthSaying = 0.2;

double cubic_evidence(const MemberLoop& loop, double frequency_hz) {
  const double period = 1.0 / (frequency_hz * loop.sample_interval_s);
  const auto factor = static_cast<std::size_t>(std::max(1.0, period / kSamplesACycle));
  const double kept = period / static_cast<double>(factor);
  if (kept < hos::kShortestPeriod) return 0.0;
  const std::optional<hos::HarmonicStatistics> found =
      hos::harmonic_statistics(hos::decimate(loop.error, factor), kept);
  return found ? found->cubic_evidence : 0.0;
}

SourceEvidence evidence_of(const MemberLoop& loop, const EventMember& member, double frequency_hz) {
  SourceEvidence evidence;
  evidence.strength = member.strength;
  evidence.line_height = LineSpectrum(loop.error, loop.sample_interval_s).height(frequency_hz);
  evidence.friction_p = loop.own.friction_p;
  evidence.outside_p = loop.own.outside_p;
  evidence.cubic_evidence = cubic_evidence(loop, frequency_hz);
  if (loop.op.empty()) return evidence;
  evidence.op_share = LineSpectrum(loop.op, loop.sample_interval_s).share(frequency_hz);
  return evidence;
}

double mean_cubic(std::span<const SourceEvidence> evidence) {
  double sum = 0.0, weight = 0.0;
  for (const SourceEvidence& one : evidence)
    sum += one.strength * std::log1p(one.cubic_evidence), weight += one.strength;
  return weight > 0.0 ? sum / weight : 0.0;
}

}  // namespace

std::vector<SourceEvidence> gather_source_evidence(std::span<const MemberLoop> loops,
                                                   const Event& event,
                                                   std::span<const CascadePair> cascades,
                                                   std::span<const Lead> leads) {
  std::vector<SourceEvidence> evidence;
  for (const EventMember& member : event.members) {
    evidence.push_back(evidence_of(loops[member.index], member, event.frequency_hz));
    evidence.back().net_lead = net_lead(leads, member.index);
    evidence.back().direct_lead = net_lead(leads, member.index, &Lead::direct);
    evidence.back().writes_setpoint =
        std::ranges::count(cascades, member.index, &CascadePair::master) > 0;
  }
  return evidence;
}

SourceFigures figures_of(std::span<const SourceEvidence> evidence) {
  SourceFigures figures;
  double highest = 1.0, best_lead = -1.0;
  for (const SourceEvidence& one : evidence) {
    highest = std::max(highest, one.line_height);
    best_lead = std::max(best_lead, one.net_lead);
  }
  for (const SourceEvidence& one : evidence) {
    const double valve = one.writes_setpoint ? 0.0 : std::min(1.0, one.strength / kFullStrength);
    figures.members.push_back({std::log(one.line_height / highest), one.writes_setpoint ? 1.0 : 0.0,
                               one.op_share, one.net_lead, one.direct_lead, valve * one.friction_p,
                               one.outside_p});
  }
  figures.none = {1.0 - best_lead, mean_cubic(evidence)};
  return figures;
}

std::vector<std::string> reasons_of(const SourceEvidence& evidence) {
  std::vector<std::string> reasons;
  if (evidence.net_lead > 0.0)
    reasons.push_back("Its past predicts the others better than theirs predicts it (" +
                      text::percent(evidence.net_lead) + " of the predicted variance, net).");
  if (evidence.friction_p > kWorthSaying)
    reasons.push_back(
        "By its own diagnosis its valve sticks, has dead band or is oversized, probability " +
        text::percent(evidence.friction_p) + ".");
  reasons.push_back("The oscillation is " + text::percent(evidence.strength) +
                    " of its error's variance and " + text::percent(evidence.op_share) +
                    " of its output's.");
  if (evidence.writes_setpoint)
    reasons.emplace_back("Its output is another loop's setpoint: it moves no valve of its own.");
  if (evidence.net_lead < 0.0)
    reasons.push_back(
        "Against it: the others' past predicts it better than its past predicts them (" +
        text::percent(-evidence.net_lead) + ", net).");
  if (evidence.outside_p > kWorthSaying)
    reasons.push_back(
        "Against it: by its own diagnosis something outside the loop disturbs it, "
        "probability " +
        text::percent(evidence.outside_p) + ".");
  return reasons;
}

}  // namespace loopscope::core::plant
