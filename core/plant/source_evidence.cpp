#include "core/plant/source_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/decimate.hpp"
#include "core/hos/harmonic_test.hpp"
#include "core/hos/period.hpp"
#include "core/model/phrases.hpp"
#include "core/plant/lead.hpp"
#include "core/plant/spectral_line.hpp"

namespace loopscope::core::plant {
namespace {

/// Samples of a cycle at which three harmonics have room; core/hos looks at slow ones in the same
/// way.
constexpr double kSamplesACycle = 12.0;

/// A loop of less is shaken by something else for the most part.
constexpr double kFullStrength = 0.25;

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
  if (loop.own.fault == Fault::friction || loop.own.fault == Fault::valve)
    evidence.valve_blamed = loop.own.confidence;
  if (loop.own.fault == Fault::disturbance) evidence.outside_blamed = loop.own.confidence;
  evidence.cubic_evidence = cubic_evidence(loop, frequency_hz);
  if (loop.op.empty()) return evidence;
  evidence.op_share = LineSpectrum(loop.op, loop.sample_interval_s).share(frequency_hz);
  return evidence;
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
    figures.members.push_back({std::log(one.line_height / highest), valve * one.valve_blamed,
                               std::log1p(one.cubic_evidence), one.outside_blamed,
                               one.writes_setpoint ? 1.0 : 0.0, one.op_share, one.net_lead,
                               one.direct_lead});
  }
  figures.no_leader = 1.0 - best_lead;
  return figures;
}

std::vector<std::string> reasons_of(const SourceEvidence& evidence) {
  std::vector<std::string> reasons;
  if (evidence.net_lead > 0.0)
    reasons.push_back("Its past foretells the others more than theirs foretells it (" +
                      model::in_percent(evidence.net_lead) + " of what is foretold, net).");
  if (evidence.valve_blamed > 0.0)
    reasons.push_back("Its own verdict blames the valve, confidence " +
                      model::in_digits(evidence.valve_blamed) + ".");
  reasons.push_back("The oscillation is " + model::in_percent(evidence.strength) +
                    " of its error's variance and " + model::in_percent(evidence.op_share) +
                    " of its output's.");
  if (evidence.writes_setpoint)
    reasons.emplace_back("Its output is another loop's setpoint: it moves no valve of its own.");
  if (evidence.net_lead < 0.0)
    reasons.push_back("Against it: the others' past foretells it more than it foretells them (" +
                      model::in_percent(-evidence.net_lead) + ", net).");
  if (evidence.outside_blamed > 0.0)
    reasons.push_back("Against it: its own verdict is a disturbance from outside, confidence " +
                      model::in_digits(evidence.outside_blamed) + ".");
  return reasons;
}

}  // namespace loopscope::core::plant
