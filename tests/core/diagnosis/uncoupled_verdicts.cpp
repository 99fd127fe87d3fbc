#include "tests/core/diagnosis/uncoupled_verdicts.hpp"

#include "core/diagnosis/decide.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::diagnosis::tests {

Verdict uncoupled(const std::string& scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  AnalysisSettings settings;
  settings.fit_model = false;  // the branch of the flow that decides where no model is fitted
  const LoopFacts facts{.integrating = scenario.find("level") != std::string::npos};
  Evidence evidence = diagnose(window, settings, facts).evidence;
  evidence.hos->ngi = -1.0;
  evidence.hos->nonlinear_p = 1.0;
  return decide(evidence, settings.hos);
}

bool shown(const Verdict& verdict) {
  constexpr double kMinConfidence = 0.3;  // config/, flags.min_confidence
  return verdict.code != VerdictCode::healthy && verdict.code != VerdictCode::insufficient_data &&
         verdict.confidence >= kMinConfidence;
}

double p_in_family(const Verdict& verdict) {
  return shown(verdict) ? verdict.p.value_or(1.0) : 1.0;
}

}  // namespace loopscope::core::diagnosis::tests
