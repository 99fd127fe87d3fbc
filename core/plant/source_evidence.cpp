#include "core/plant/source_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>

#include "core/hos/decimate.hpp"
#include "core/hos/harmonic_test.hpp"
#include "core/hos/period.hpp"
#include "core/model/phrases.hpp"
#include "core/plant/envelope.hpp"
#include "core/plant/lead.hpp"
#include "core/plant/spectral_line.hpp"

namespace loopscope::core::plant {
namespace {

/// Samples of a cycle at which three harmonics have room; core/hos looks at slow ones in the same
/// way.
constexpr double kSamplesACycle = 12.0;

/// A loop of less is shaken by something else for the most part.
constexpr double kFullStrength = 0.25;
constexpr double kFewestCycles = 4.0;  // at which a harmonic can be compared
/// Locked power of a third harmonic below this share of the first is what noise leaves.
constexpr double kFaintHarmonic = 0.02;

double cubic_evidence(const MemberLoop& loop, double frequency_hz) {
  const double period = 1.0 / (frequency_hz * loop.sample_interval_s);
  const auto factor = static_cast<std::size_t>(std::max(1.0, period / kSamplesACycle));
  const double kept = period / static_cast<double>(factor);
  if (kept < hos::kShortestPeriod) return 0.0;
  const std::optional<hos::HarmonicStatistics> found =
      hos::harmonic_statistics(hos::decimate(loop.error, factor), kept);
  return found ? found->cubic_evidence : 0.0;
}

/// Of the output's third harmonic what is locked to the first, by the power of the first: the
/// squared mean of z3 / (z1 / |z1|)^3 less what turns freely leaves of it.
double third_harmonic(const MemberLoop& loop, double frequency_hz) {
  MemberLoop output = loop;
  output.error = loop.op;
  const Demodulator demodulator(output);
  const Envelope first = demodulator.envelope(frequency_hz);
  const Envelope third = demodulator.envelope(3.0 * frequency_hz);
  std::complex<double> locked = 0.0;
  double count = 0.0, power = 0.0, third_power = 0.0;
  for (std::int64_t j = first.first; j < first.end(); ++j) {
    const std::complex<double> z1 = first.at(j), z3 = third.at(3 * j);
    if (!std::isfinite(z1.real()) || !std::isfinite(z3.real()) || !(std::abs(z1) > 0.0)) continue;
    const std::complex<double> turn = z1 / std::abs(z1);
    locked += z3 * std::conj(turn * turn * turn);
    count += 1.0, power += std::norm(z1), third_power += std::norm(z3);
  }
  if (count < kFewestCycles) return 0.0;
  return std::max(0.0, (std::norm(locked) - third_power) / count / power);
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
  evidence.op_third = third_harmonic(loop, frequency_hz);
  return evidence;
}

double mean_outside_blamed(std::span<const SourceEvidence> evidence) {
  double sum = 0.0, weight = 0.0;
  for (const SourceEvidence& one : evidence)
    sum += one.strength * one.outside_blamed, weight += one.strength;
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
                               one.writes_setpoint ? 1.0 : 0.0, one.net_lead,
                               std::log1p(one.op_third / kFaintHarmonic), one.op_share});
  }
  figures.outside = {mean_outside_blamed(evidence), 1.0 - best_lead};
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
  if (evidence.op_third > kFaintHarmonic)
    reasons.push_back("Its output has a third harmonic, locked to the oscillation, of " +
                      model::in_percent(evidence.op_third) + " of the first one's power.");
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
