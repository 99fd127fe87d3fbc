#include "core/diagnosis/diagnose.hpp"

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/diagnosis/loop_state.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/explain.hpp"

namespace loopscope::core {
namespace {

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
