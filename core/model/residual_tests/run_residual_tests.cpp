#include "core/model/residual_tests/run_residual_tests.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/record/move_direction.hpp"
#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/tests/coupling.hpp"
#include "core/model/residual_tests/tests/op_direction.hpp"
#include "core/model/residual_tests/tests/op_dynamics.hpp"
#include "core/model/residual_tests/tests/op_level.hpp"
#include "core/model/residual_tests/tests/periodic.hpp"
#include "core/model/residual_tests/tests/response_level.hpp"
#include "core/model/residual_tests/tests/sensor.hpp"
#include "core/model/residual_tests/tests/time_event.hpp"
#include "core/model/residual_tests/tests/time_gain.hpp"
#include "core/model/residual_tests/tests/time_spread.hpp"
#include "core/model/residual_tests/tests/white.hpp"

namespace loopscope::core::model {
namespace {

void add(std::optional<TestOutcome> answer, std::vector<TestOutcome>& answers) {
  if (answer) answers.push_back(std::move(*answer));
}

/// The one-step errors of every recorded sample behind the warm-up, pv units; NaN elsewhere.
std::vector<double> residual_of(const LoopData& data, const Fit& fit) {
  std::vector<double> residual(data.size(), std::nan(""));
  for (const auto* rows : {&data.rows.fit, &data.rows.score, &data.rows.guard}) {
    for (const Range& range : *rows) {
      for (std::size_t k = range.first; k < range.end; ++k)
        residual[k] = fit.innovations[k] * data.pv_scale;
    }
  }
  return residual;
}

/// pv less what the model says comes from outside, pv units; empty where it says nothing. A wave
/// that the model has would else be asked for again: op may explain its line in the residual, so
/// that it is sought in pv.
std::vector<double> undisturbed_pv(const ModelInput& input, const LoopData& data, const Fit& fit) {
  Fit outside = fit;
  std::ranges::fill(outside.coefficients, 0.0);
  const auto& effects = fit.structure.effects;
  std::size_t at = fit.taps();
  for (std::size_t place = 0; place < effects.size(); ++place) {
    const std::span<const double> own = coefficients_of(fit, place);
    if (is_from_outside(effects[place]->kind()))
      std::ranges::copy(own, outside.coefficients.begin() + static_cast<std::ptrdiff_t>(at));
    at += own.size();
  }
  if (std::ranges::all_of(outside.coefficients, [](double value) { return value == 0.0; }))
    return {};
  std::vector<double> result = deterministic_output(data, outside);
  std::ranges::transform(input.pv, result, result.begin(),
                         [&](double pv, double wave) { return pv - data.pv_scale * wave; });
  return result;
}

bool same_search(EffectKind a, EffectKind b) {
  return a == b || (is_valve_hysteresis(a) && is_valve_hysteresis(b));
}

bool asks_for(const TestOutcome& answer, EffectKind effect) {
  return std::ranges::any_of(answer.nominations, [effect](const Nomination& nomination) {
    return nomination.p <= kNominates && same_search(nomination.effect, effect);
  });
}

}  // namespace

std::vector<TestOutcome> test_residual(const ResidualView& view) {
  const std::optional<ResidualContext> context = prepare_context(view);
  if (!context) return {};
  std::vector<TestOutcome> answers;
  add(test_white(*context), answers);
  add(test_op_dynamics(*context), answers);
  add(test_op_direction(*context), answers);
  add(test_op_level(*context), answers);
  add(test_response_level(*context), answers);
  add(test_time_gain(*context), answers);
  add(test_time_spread(*context), answers);
  add(test_time_event(*context), answers);
  add(test_periodic(*context), answers);
  add(test_grid(*context), answers);
  add(test_held(*context), answers);
  return answers;
}

std::vector<double> response_of(const LoopData& data, const Fit& fit) {
  std::vector<double> response = deterministic_output(data, fit);
  for (double& value : response) value *= data.pv_scale;
  return response;
}

std::vector<TestOutcome> run_residual_tests(const ModelInput& input, const LoopData& data,
                                            const Fit& fit) {
  const std::vector<double> residual = residual_of(data, fit);
  const std::vector<double> direction = move_direction(input.op);
  const std::vector<double> response = response_of(data, fit);
  const std::vector<double> undisturbed = undisturbed_pv(input, data, fit);
  return test_residual(
      {residual, input.op, direction, response, input.pv, input.sample_interval_s, undisturbed});
}

std::vector<TestOutcome> run_coupling_tests(const LoopData& data, const Fit& fit,
                                            std::uint64_t seed) {
  return test_coupling(residual_of(data, fit), seed);
}

Nominations::Nominations(const std::vector<TestOutcome>& answers) {
  for (const TestOutcome& answer : answers) {
    for (const Nomination& nomination : answer.nominations) add(nomination);
  }
  order();
}

Nominations::Nominations(std::span<const Nomination> nominations) {
  for (const Nomination& nomination : nominations) add(nomination);
  order();
}

void Nominations::add(const Nomination& nomination) {
  if (nomination.p <= kNominates)
    nominations_.push_back(nomination);
  else if (nomination.p <= kSignificant)
    hints_.push_back(nomination.effect);
}

void Nominations::order() {
  std::ranges::stable_sort(nominations_, {}, &Nomination::p);
}

std::size_t Nominations::rank(EffectKind effect) const {
  std::vector<EffectKind> before;
  for (const Nomination& nomination : nominations_) {
    if (same_search(nomination.effect, effect)) return before.size() + 1;
    const auto known = [&](EffectKind other) { return same_search(other, nomination.effect); };
    if (std::ranges::none_of(before, known)) before.push_back(nomination.effect);
  }
  return 0;
}

double Nominations::promise(EffectKind effect) const {
  const std::vector<Nomination> asked = nominations(effect);
  return asked.empty() ? 0.0 : -2.0 * std::log(asked.front().p);
}

bool Nominations::hints_at(EffectKind effect) const {
  return std::ranges::find(hints_, effect) != hints_.end();
}

std::vector<Nomination> Nominations::nominations(EffectKind effect) const {
  std::vector<Nomination> result;
  std::ranges::copy_if(nominations_, std::back_inserter(result),
                       [&](const Nomination& one) { return same_search(one.effect, effect); });
  return result;
}

std::vector<AskedBy> asked_by(EffectKind effect, const std::vector<TestOutcome>& before,
                              const std::vector<TestOutcome>& after) {
  std::vector<AskedBy> result;
  for (const TestOutcome& answer : before) {
    if (!asks_for(answer, effect)) continue;
    const Question& test = answer.question;
    AskedBy by{test.name, test.p, std::nullopt, test.statement};
    const auto again = std::ranges::find(
        after, test.name, [](const TestOutcome& other) { return other.question.name; });
    if (again != after.end()) by.p_after = again->question.p;
    result.push_back(std::move(by));
  }
  std::ranges::stable_sort(result, {}, &AskedBy::p);
  return result;
}

double share_left(const std::vector<AskedBy>& asked_by) {
  double before = 0.0, after = 0.0;
  for (const AskedBy& by : asked_by) {
    before += std::log(by.p);
    after += std::log(by.p_after.value_or(1.0));
  }
  return before < 0.0 ? std::clamp(after / before, 0.0, 1.0) : 0.0;
}

std::vector<AskedEffect> asked_effects(const std::vector<TestOutcome>& answers) {
  std::vector<AskedEffect> result;
  for (const TestOutcome& answer : answers) {
    for (const Nomination& nomination : answer.nominations) {
      if (nomination.p <= kNominates)
        result.push_back({nomination.effect, answer.question.name, nomination.p});
    }
  }
  std::ranges::stable_sort(result, {}, &AskedEffect::p);
  return result;
}

}  // namespace loopscope::core::model
