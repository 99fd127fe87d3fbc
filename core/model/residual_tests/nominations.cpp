#include "core/model/residual_tests/nominations.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::model {
namespace {

bool same_search(EffectKind a, EffectKind b) {
  return a == b || (is_valve_hysteresis(a) && is_valve_hysteresis(b));
}

bool asks_for(const TestOutcome& answer, EffectKind effect) {
  return std::ranges::any_of(answer.nominations, [effect](const Nomination& nomination) {
    return nomination.p <= kNominates && same_search(nomination.effect, effect);
  });
}

}  // namespace

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
