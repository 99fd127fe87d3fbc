#include "core/model/residual_tests/sensor_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// A fact of the values, which nothing else makes by chance.
constexpr double kClearP = 1e-6;

const Nomination* nominated(const std::vector<TestOutcome>& answers, EffectKind kind) {
  for (const TestOutcome& answer : answers) {
    for (const Nomination& nomination : answer.nominations) {
      if (nomination.effect == kind && nomination.p <= kClearP) return &nomination;
    }
  }
  return nullptr;
}

Step sensor_step(EffectKind kind, double p, const Parameter& parameter, double error) {
  constexpr double kSmallestP = 1e-300;
  Step step;
  step.effect = kind;
  step.parameters = {parameter};
  step.holdout_error_before = error;
  step.holdout_error_after = error;
  step.p = p;
  step.evidence = -2.0 * std::log(std::max(p, kSmallestP));
  step.margin = step.evidence;
  return step;
}

}  // namespace

SensorFinding find_sensor_steps(double error, const std::vector<TestOutcome>& answers) {
  const Nominations asked(answers);
  SensorFinding finding;
  const Nomination* held = nominated(answers, EffectKind::sensor_hold);
  if (held && held->hold_samples && *held->hold_samples >= 2.0) {
    const double samples = std::round(*held->hold_samples);
    if (!held->at_sample) finding.hold_samples = static_cast<std::size_t>(samples);
    finding.hold =
        sensor_step(EffectKind::sensor_hold, held->p, {"samples", "", samples, {}, {}}, error);
    finding.hold->asked_by = asked_by(EffectKind::sensor_hold, answers, {});
    finding.hold->promise_rank = asked.rank(EffectKind::sensor_hold);
    finding.hold->statement = "pv is renewed only every " + text::number(samples) + " samples.";
  }
  const Nomination* grid = nominated(answers, EffectKind::sensor_quantisation);
  if (grid && grid->step) {
    finding.quantisation = sensor_step(EffectKind::sensor_quantisation, grid->p,
                                       {"step", "pv", *grid->step, {}, {}}, error);
    finding.quantisation->asked_by = asked_by(EffectKind::sensor_quantisation, answers, {});
    finding.quantisation->promise_rank = asked.rank(EffectKind::sensor_quantisation);
    finding.quantisation->statement = "The values of pv lie on a grid of " +
                                      text::units_of_pv(*grid->step) +
                                      ", coarse beside their fast noise.";
  }
  return finding;
}

}  // namespace loopscope::core::model
