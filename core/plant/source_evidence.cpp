#include "core/plant/source_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/decimate.hpp"
#include "core/hos/harmonic_test.hpp"
#include "core/hos/period.hpp"
#include "core/model/limit_cycle_cause.hpp"
#include "core/model/phrases.hpp"

namespace loopscope::core::plant {
namespace {

/// Samples of a cycle at which three harmonics have room; core/hos looks at slow ones in the same
/// way.
constexpr double kSamplesACycle = 12.0;

/// Every source of the plants that the weights were fitted on is stronger.
constexpr double kFullStrength = 0.25;

/// Held-out ln ratios below this are what an effect that is not there reaches.
constexpr double kFaint = 0.02;

double cubic_evidence(const MemberLoop& loop, double frequency_hz) {
  const double period = 1.0 / (frequency_hz * loop.sample_interval_s);
  const auto factor = static_cast<std::size_t>(std::max(1.0, period / kSamplesACycle));
  const double kept = period / static_cast<double>(factor);
  if (kept < hos::kShortestPeriod) return 0.0;
  const std::optional<hos::HarmonicStatistics> found =
      hos::harmonic_statistics(hos::decimate(loop.error, factor), kept);
  return found ? found->cubic_evidence : 0.0;
}

void look_at_the_cycle(const MemberLoop& loop, SourceEvidence& evidence) {
  if (loop.pv.empty() || loop.op.empty()) return;
  const model::CycleCause cause = model::judge_limit_cycle(loop.pv, loop.op, loop.sp);
  if (!(cause.evidence.cycles > 0.0)) return;
  evidence.cycle_score = cause.score;
}

double in_faint(double explained) {
  return std::log1p(std::max(0.0, explained) / kFaint);
}

std::string factor_text(double explained) {
  return "by a factor of " + model::in_digits(std::exp(explained));
}

}  // namespace

SourceEvidence gather_source_evidence(const MemberLoop& loop, double frequency_hz,
                                      double strength) {
  SourceEvidence evidence;
  evidence.strength = strength;
  evidence.valve_explained = loop.own.valve_explained;
  evidence.outside_explained = loop.own.outside_explained;
  if (loop.own.fault == Fault::friction || loop.own.fault == Fault::valve)
    evidence.valve_blamed = loop.own.confidence;
  evidence.cubic_evidence = cubic_evidence(loop, frequency_hz);
  look_at_the_cycle(loop, evidence);
  return evidence;
}

std::array<double, kSourceFigures> figures_of(const SourceEvidence& evidence) {
  const double valve =
      evidence.writes_setpoint ? 0.0 : std::min(1.0, evidence.strength / kFullStrength);
  return {evidence.strength,
          valve * in_faint(evidence.valve_explained),
          in_faint(evidence.outside_explained),
          valve * evidence.valve_blamed,
          valve * evidence.cycle_score,
          std::log1p(evidence.cubic_evidence)};
}

std::vector<std::string> reasons_of(const SourceEvidence& evidence) {
  std::vector<std::string> reasons;
  if (evidence.writes_setpoint)
    reasons.emplace_back("Its output is another loop's setpoint: it moves no valve of its own.");
  if (evidence.valve_explained > kFaint)
    reasons.push_back("A valve that sticks or has play lowers the error of the loop's model " +
                      factor_text(evidence.valve_explained) + " on samples it has not seen.");
  if (evidence.cycle_score >= 0.5)
    reasons.push_back("The shape of its cycle is that of a sticking valve (score " +
                      model::in_digits(evidence.cycle_score) + ", 0.5 and more says so).");
  if (evidence.valve_blamed > 0.0)
    reasons.push_back("Its own verdict blames the valve, confidence " +
                      model::in_digits(evidence.valve_blamed) + ".");
  reasons.push_back("The oscillation is " + model::in_percent(evidence.strength) +
                    " of its error's variance.");
  if (evidence.outside_explained > kFaint)
    reasons.push_back("Against it: an oscillation from outside lowers the error of its model " +
                      factor_text(evidence.outside_explained) + ".");
  if (evidence.cycle_score < 0.5)
    reasons.push_back("Against it: the shape of its cycle does not show a sticking valve (score " +
                      model::in_digits(evidence.cycle_score) + ").");
  return reasons;
}

}  // namespace loopscope::core::plant
