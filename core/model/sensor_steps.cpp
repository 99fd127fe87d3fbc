#include "core/model/sensor_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/questions/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// A fact of the values, which nothing else makes by chance.
constexpr double kClearP = 1e-6;

const Nomination* nominated(const std::vector<Answer>& answers, EffectKind kind) {
  for (const Answer& answer : answers) {
    for (const Nomination& nomination : answer.nominations) {
      if (nomination.effect == kind && nomination.p <= kClearP) return &nomination;
    }
  }
  return nullptr;
}

Step sensor_step(EffectKind kind, double p, Parameter parameter, double before, double after) {
  Step step;
  step.effect = kind;
  step.parameters = {parameter};
  step.holdout_error_before = before;
  step.holdout_error_after = after;
  step.p = p;
  step.evidence = -2.0 * std::log(std::max(p, 1e-300));
  step.margin = step.evidence;
  return step;
}

/// Rows on which pv differs from the sample before.
std::vector<Range> renewed(const LoopData& data, const std::vector<Range>& rows) {
  std::vector<Range> result;
  for (const Range& range : rows) {
    for (std::size_t k = std::max<std::size_t>(1, range.first); k < range.end; ++k) {
      if (data.pv[k] != data.pv[k - 1]) result.push_back({k, k + 1});
    }
  }
  return result;
}

/// Mean square over all rows of a predictor that knows which samples are renewed.
double held_error(const LoopData& data, const Fit& fit, const Rows& rows) {
  LoopData renewals = data;
  renewals.rows = rows;
  const double share = static_cast<double>(rows.score_count()) /
                       static_cast<double>(std::max<std::size_t>(1, data.rows.score_count()));
  return polish(renewals, fit.structure, 4).score_error * share;
}

}  // namespace

SensorFinding find_sensor_steps(const LoopData& data, const Fit& baseline,
                                const std::vector<Answer>& answers) {
  SensorFinding finding;
  const double square = data.pv_scale * data.pv_scale;
  const double before = baseline.score_error * square;
  if (const Nomination* held = nominated(answers, EffectKind::sensor_hold); held && held->hold_samples) {
    const Rows rows{renewed(data, data.rows.fit), renewed(data, data.rows.score)};
    constexpr std::size_t kFewest = 60;
    if (rows.fit_count() >= kFewest && rows.score_count() >= kFewest) {
      finding.rows = rows;
      Step step = sensor_step(EffectKind::sensor_hold, held->p, {"samples", "", *held->hold_samples, {}, {}},
                              before, held_error(data, baseline, rows) * square);
      step.statement = "The sensor is renewed every " + in_digits(*held->hold_samples) + " samples only.";
      finding.steps.push_back(std::move(step));
    }
  }
  if (const Nomination* grid = nominated(answers, EffectKind::sensor_quantisation); grid && grid->step) {
    Step step = sensor_step(EffectKind::sensor_quantisation, grid->p, {"step", "pv", *grid->step, {}, {}}, before, before);
    step.statement = "The values of pv lie on a grid of " + in_digits(*grid->step) + ", coarse beside its fast noise.";
    finding.steps.push_back(std::move(step));
  }
  return finding;
}

}  // namespace loopscope::core::model
