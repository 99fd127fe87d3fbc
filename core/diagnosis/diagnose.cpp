#include "core/diagnosis/diagnose.hpp"

#include <algorithm>

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/diagnosis/loop_state.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/hos/slow_look.hpp"
#include "core/model/explain.hpp"
#include "core/signal/prepare.hpp"

namespace loopscope::core {
namespace {

/// The span that the slow look wants, as far as the settings allow, if it is longer than a window;
/// and all of it where pv stands still in the whole window and nothing is known from before: a calm
/// loop in a coarse archive stood as long before.
std::size_t wanted_span(const FirstLook& first, const signal::LoopWindow& window,
                        const AnalysisSettings& settings) {
  const signal::PrepareSettings& prepare = settings.prepare;
  if (!first.loop.control.controlling()) return 0;
  const std::optional<double> period = first.period_samples();
  const std::size_t most = prepare.slow_span_windows * prepare.window_samples;
  const bool unknown = first.loop.still && first.loop.still->whole && !window.pv_past;
  const std::size_t slow =
      period ? std::min(hos::slow_span(*period, settings.hos), most) : std::size_t{0};
  const std::size_t wanted = unknown ? most : slow;
  return wanted > prepare.window_samples ? wanted : 0;
}

bool wants_model(const FirstLook& first, const Evidence& evidence, const AnalysisSettings& settings,
                 const ModelPlan& plan) {
  if (!settings.fit_model || !can_be_modelled(first, evidence)) return false;
  return !plan.cause || triggers_model(evidence, settings, *plan.cause);
}

void fit_model(const FirstLook& first, const LoopFacts& facts, const ModelPlan& plan,
               Diagnosis& diagnosis) {
  if (!plan.traces) {
    const auto& cycle = diagnosis.evidence.cycle;
    diagnosis.evidence.model = explain_loop(first, facts, cycle ? &*cycle : nullptr);
    return;
  }
  diagnosis.traces = trace_loop(first, facts);
  if (diagnosis.traces) diagnosis.evidence.model = diagnosis.traces->explanation;
}

}  // namespace

std::optional<double> FirstLook::period_samples() const {
  if (!oscillation.present || !oscillation.period_s) return std::nullopt;
  return *oscillation.period_s / loop.sample_interval_s;
}

FirstLook first_look(const signal::LoopWindow& window, const AnalysisSettings& settings) {
  FirstLook first;
  first.loop = signal::prepare(window, settings.prepare);
  if (first.loop.quality.usable)
    first.oscillation =
        loop::find_oscillation(first.loop.error, window.sample_interval_s, settings.oscillation);
  first.slow_span_samples = wanted_span(first, window, settings);
  return first;
}

model::ModelInput model_input(const FirstLook& first, const LoopFacts& facts,
                              const model::CycleCause* cycle) {
  const signal::PreparedLoop& loop = first.loop;
  return {loop.pv,    loop.op_percent,        loop.sp,
          loop.error, loop.sample_interval_s, loop.op_in_percent(),
          facts.seed, facts.without,          cycle};
}

bool can_be_modelled(const FirstLook& first, const Evidence& evidence) {
  const signal::DataQuality& prepared = first.loop.quality;
  const bool sees_enough =
      prepared.refusals.empty() || prepared.archive == signal::Archive::coarser;
  return evidence.data_quality.usable && sees_enough &&
         diagnosis::state_of(evidence) != diagnosis::LoopState::not_controlling && !evidence.still;
}

bool ModelTrigger::given_by(diagnosis::VerdictCode code, double confidence,
                            std::optional<double> p) const {
  using diagnosis::VerdictCode;
  return diagnosis::catalogue_entry(code).weight > 0.0 && p.value_or(0.0) <= largest_p &&
         confidence >= least_confidence;
}

bool triggers_model(const Evidence& evidence, const AnalysisSettings& settings,
                    const ModelTrigger& cause) {
  const diagnosis::Verdict verdict = diagnosis::decide(evidence, settings.hos, settings.decision);
  return cause.given_by(verdict.code, verdict.confidence, verdict.p);
}

std::optional<model::Explanation> explain_loop(const FirstLook& first, const LoopFacts& facts,
                                               const model::CycleCause* cycle) {
  return model::explain(model_input(first, facts, cycle));
}

std::optional<model::ExplanationTraces> trace_loop(const FirstLook& first, const LoopFacts& facts) {
  return model::trace_explanation(model_input(first, facts));
}

Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                   const LoopFacts& facts, const signal::LoopWindow* long_window) {
  return diagnose(first_look(window, settings), settings, facts, long_window);
}

Diagnosis diagnose(const FirstLook& first, const AnalysisSettings& settings, const LoopFacts& facts,
                   const signal::LoopWindow* long_window, const ModelPlan& plan) {
  const auto done = [&](Stage stage) {
    if (plan.done) plan.done(stage);
  };
  diagnosis::check(settings.decision);
  Diagnosis diagnosis;
  Evidence& evidence = diagnosis.evidence;
  evidence = gather_evidence(first, settings, facts, long_window);
  done(Stage::statistics);
  if (wants_model(first, evidence, settings, plan)) {
    fit_model(first, facts, plan, diagnosis);
    if (evidence.model) done(Stage::model);
  }
  diagnosis.verdict = diagnosis::decide(evidence, settings.hos, settings.decision);
  done(Stage::verdict);
  return diagnosis;
}

}  // namespace loopscope::core
