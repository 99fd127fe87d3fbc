#include "core/diagnosis/diagnose.hpp"

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/diagnosis/loop_model.hpp"

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
