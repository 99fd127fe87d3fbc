#include "core/diagnosis/plant_member.hpp"

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// That one of the causes is there which tell neighbours so.
double probability_of(plant::Fault blamed, const Verdict& verdict) {
  double none = 1.0;
  for (const CauseReport& cause : verdict.causes)
    if (catalogue_entry(cause.code).blames == blamed) none *= 1.0 - cause.probability;
  return 1.0 - none;
}

}  // namespace

plant::OwnFindings own_findings(const Verdict& verdict) {
  return {catalogue_entry(verdict.code).blames, verdict.confidence,
          probability_of(plant::Fault::friction, verdict),
          probability_of(plant::Fault::disturbance, verdict)};
}

}  // namespace loopscope::core::diagnosis
