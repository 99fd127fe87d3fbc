#include "core/diagnosis/diagnose.hpp"

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/diagnosis/loop_model.hpp"

namespace loopscope::core {

Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                   const LoopFacts& facts, const signal::LoopWindow* long_window) {
  return diagnose(first_look(window, settings), settings, facts, long_window);
}

Diagnosis diagnose(const FirstLook& first, const AnalysisSettings& settings, const LoopFacts& facts,
                   const signal::LoopWindow* long_window) {
  Diagnosis diagnosis;
  diagnosis.evidence = gather_evidence(first, settings, facts, long_window);
  if (settings.fit_model && can_be_modelled(first, diagnosis.evidence)) {
    diagnosis.evidence.model = explain_loop(first, facts);
  }
  diagnosis.verdict = diagnosis::decide(diagnosis.evidence, settings.hos);
  return diagnosis;
}

}  // namespace loopscope::core
