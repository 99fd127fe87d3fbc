#include "daemon/lab/reproduce/reproduction_json.hpp"

#include "daemon/lab/reproduce/industrial_case.hpp"

namespace loopscope::daemon {

namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& spread) {
  return {{"median", spread.median},
          {"p10", spread.p10},
          {"p90", spread.p90},
          {"min", spread.min},
          {"max", spread.max}};
}

Json figure_json(const PaperFigure& paper, const Spread& ours) {
  Json figure = {{"paper", nullptr}};
  figure.update(spread_json(ours));
  figure["agreement"] = nullptr;
  figure["why"] = nullptr;
  if (!paper.value) return figure;
  const Agreement agreement = agreement_of(*paper.value, ours);
  figure["paper"] = *paper.value;
  figure["agreement"] = name(agreement);
  if (agreement != Agreement::met && !paper.obstacle.empty()) figure["why"] = paper.obstacle;
  return figure;
}

Json peaks_json(const Measurement& measurement) {
  Json peaks = Json::array();
  for (const PeakShare& peak : measurement.peaks) {
    peaks.push_back({{"f1", peak.peak.f1},
                     {"f2", peak.peak.f2},
                     {"in_principal_domain", peak.in_principal_domain},
                     {"share", peak.share}});
  }
  return peaks;
}

Json maximum_json(const Measurement& measurement) {
  if (measurement.peak_seeds == 0.0) return nullptr;
  return {{"f1", spread_json(measurement.max_f1)},
          {"f2", spread_json(measurement.max_f2)},
          {"share", measurement.peak_seeds}};
}

Json verdict_json(const Measurement& measurement) {
  if (!measurement.verdict) return nullptr;
  return {{"code", measurement.verdict->code}, {"share", measurement.verdict->share}};
}

Json example_json(const MeasuredExample& measured) {
  const auto& [example, measurement] = measured;
  const bool gaussian = example.decision == PaperDecision::gaussian;
  return {{"section", example.section},
          {"title", example.title},
          {"scenario", example.scenario},
          {"ngi", figure_json(example.ngi, measurement.ngi)},
          {"nli", figure_json(example.nli, measurement.nli)},
          {"error_std", spread_json(measurement.error_std)},
          {"decision",
           {{"paper", gaussian ? "gaussian" : "nonlinear"}, {"share", measurement.decision_share}}},
          {"peaks", peaks_json(measurement)},
          {"maximum", maximum_json(measurement)},
          {"paper_cause", example.is_loop ? Json(example.paper_cause) : Json(nullptr)},
          {"verdict", verdict_json(measurement)},
          {"remark", example.remark}};
}

Json industrial_json() {
  Json cases = Json::array();
  for (const IndustrialCase& one : industrial_cases()) {
    cases.push_back({{"section", one.section},
                     {"title", one.title},
                     {"paper_ngi", one.ngi},
                     {"paper_nli", one.nli},
                     {"paper_cause", one.paper_cause},
                     {"answer", one.answer}});
  }
  return cases;
}

}  // namespace

nlohmann::ordered_json reproduction_json(const Reproduction& reproduction) {
  Json examples = Json::array();
  for (const MeasuredExample& measured : reproduction.examples) {
    examples.push_back(example_json(measured));
  }
  return {{"seeds", reproduction.seeds},
          {"examples", std::move(examples)},
          {"industrial_cases", industrial_json()}};
}

}  // namespace loopscope::daemon
