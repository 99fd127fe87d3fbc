#include "tests/effects/draws.hpp"

#include <algorithm>
#include <chrono>

#include "core/diagnosis/diagnose.hpp"
#include "tests/effects/residual_tests.hpp"
#include "tests/effects/window_of.hpp"
#include "tests/support/in_threads.hpp"

namespace loopscope::tests::effects {
namespace {

/// Evidence without a member `model` has no explanation.
template <typename Evidence>
const core::model::Explanation* model_of(const Evidence& evidence) {
  if constexpr (requires { evidence.model; })
    return evidence.model ? &*evidence.model : nullptr;
  else
    return nullptr;
}

/// Of the plan, two places on, round to the first one.
const std::string& other_kind(const Plan& plan, const std::string& kind) {
  const auto place = std::ranges::find(plan.kinds, kind) - plan.kinds.begin();
  return plan.kinds[(static_cast<std::size_t>(place) + 2) % plan.kinds.size()];
}

Outcome run_draw(const std::string& kind, std::uint64_t seed, const Plan& plan) {
  using Clock = std::chrono::steady_clock;
  const Record record = generate(kind, seed, plan.size, plan.noise);
  const core::signal::LoopWindow window = window_of(record, record.interval_s);
  core::LoopFacts facts{
      .integrating = record.truth.loop.integrating, .seed = seed, .without = plan.without};
  std::vector<core::model::TestOutcome> others;
  if (plan.permuted) {
    others = answers_of(other_kind(plan, kind), seed, plan);
    facts.without.hear_instead(others);
  }
  const auto start = Clock::now();
  const core::Diagnosis diagnosis = core::diagnose(window, {}, facts);
  const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
  Outcome outcome = judge(record, std::string(name(diagnosis.verdict.code)),
                          diagnosis.verdict.confidence, model_of(diagnosis.evidence));
  outcome.milliseconds = taken.count();
  return outcome;
}

}  // namespace

std::vector<std::vector<Outcome>> run_draws(const Plan& plan) {
  std::vector<std::vector<Outcome>> outcomes(plan.kinds.size(), std::vector<Outcome>(plan.draws));
  in_threads(plan.kinds.size() * plan.draws, plan.threads, [&](std::size_t job) {
    const std::size_t kind = job / plan.draws;
    const std::size_t draw = job % plan.draws;
    outcomes[kind][draw] = run_draw(plan.kinds[kind], plan.seed + draw, plan);
  });
  return outcomes;
}

}  // namespace loopscope::tests::effects
