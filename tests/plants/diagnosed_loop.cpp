#include "tests/plants/diagnosed_loop.hpp"

#include <algorithm>
#include <string_view>

#include "core/diagnosis/diagnose.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "tests/effects/window_of.hpp"
#include "tests/support/in_threads.hpp"

namespace loopscope::tests::plants {
namespace {

/// As the view flagged_loop counts them.
std::size_t tests_of(const core::Diagnosis& diagnosis) {
  const core::Evidence& evidence = diagnosis.evidence;
  std::size_t tests = 0;
  const auto count = [&tests](bool computed) { tests += computed ? 1U : 0U; };
  if (evidence.data_quality.usable) {
    count(evidence.hos && evidence.hos->nonlinear_p);
    count(evidence.oscillation.p.has_value());
    count(evidence.performance.harris_p.has_value());
    // A model that may claim something tests the next effect and what is left.
    if (evidence.model && evidence.model->excited) tests += 2;
  }
  return std::max<std::size_t>(tests, diagnosis.verdict.p ? 1U : 0U);
}

std::optional<double> fault_probability_of(const core::diagnosis::Verdict& verdict) {
  for (const core::diagnosis::CauseReport& cause : verdict.causes)
    if (cause.code == core::diagnosis::VerdictCode::healthy) return 1.0 - cause.probability;
  return std::nullopt;
}

}  // namespace

DiagnosedLoop diagnosed(const core::Diagnosis& diagnosis) {
  DiagnosedLoop result{std::string(name(diagnosis.verdict.code)),
                       diagnosis.verdict.confidence,
                       diagnosis.verdict.p,
                       tests_of(diagnosis),
                       {},
                       fault_probability_of(diagnosis.verdict)};
  if (diagnosis.evidence.model)
    for (const auto& step : diagnosis.evidence.model->steps)
      result.steps.emplace_back(name(step.effect));
  return result;
}

DiagnosedLoop diagnose_loop(const PlantLoop& loop, const core::model::Without& without) {
  const effects::Record record = record_of(loop);
  const core::LoopFacts facts{
      .integrating = record.truth.loop.integrating, .seed = loop.seed, .without = without};
  return diagnosed(core::diagnose(effects::window_of(record, record.interval_s), {}, facts));
}

std::vector<DiagnosedLoop> diagnose_plant(const std::vector<PlantLoop>& plant, unsigned threads,
                                          const core::model::Without& without) {
  std::vector<DiagnosedLoop> all(plant.size());
  in_threads(plant.size(), threads,
             [&](std::size_t k) { all[k] = diagnose_loop(plant[k], without); });
  return all;
}

}  // namespace loopscope::tests::plants
