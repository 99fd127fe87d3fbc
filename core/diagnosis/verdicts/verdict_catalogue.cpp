#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

#include <array>
#include <cstddef>

namespace loopscope::core::diagnosis {
namespace {

using plant::Fault;

constexpr std::array kCatalogue{
    CatalogueEntry{VerdictCode::healthy, "healthy", 0.0, "", Fault::none, false,
                   "Nothing is left to explain", "Nothing was found that asks for action.",
                   "Nothing to do."},
    CatalogueEntry{
        VerdictCode::valve_stiction, "valve_stiction", 1.0, "friction", Fault::friction, true,
        "The valve sticks and jumps", "The control valve sticks.",
        "Check in the field: put the controller in manual, step the output by 0.5 % at a time and "
        "watch when the stem moves; then packing, actuator and positioner."},
    CatalogueEntry{
        VerdictCode::valve_deadband, "valve_deadband", 0.8, "friction", Fault::friction, true,
        "The valve has play (backlash)", "The control valve has dead band.",
        "Check linkage and positioner for backlash; measure the travel in both directions."},
    CatalogueEntry{VerdictCode::valve_saturation, "valve_saturation", 0.9, "limit", Fault::valve,
                   true, "The valve runs into a limit", "The controller output is at its limit.",
                   "Check whether the valve is too small, the bypass open or the setpoint out of "
                   "reach; tune only after that."},
    CatalogueEntry{VerdictCode::valve_characteristic, "valve_characteristic", 0.7, "curve",
                   Fault::valve, true,
                   "The valve's characteristic is bent: wear, corroded seat, wrong trim",
                   "The valve's characteristic is curved.",
                   "Check trim and seat for wear or corrosion and compare with the data sheet."},
    CatalogueEntry{VerdictCode::valve_oversized, "valve_oversized", 0.6, "friction",
                   Fault::friction, true, "Tiny movements of the valve move the process a lot",
                   "Tiny moves of the valve swing the process variable: the valve is too large.",
                   "Compare the valve's size with the usual flow; consider a smaller trim or "
                   "valve."},
    CatalogueEntry{VerdictCode::process_nonlinearity, "process_nonlinearity", 0.6, "curve",
                   Fault::process, false, "The process itself is nonlinear",
                   "The process itself is nonlinear.",
                   "Consider gain scheduling or a linearising function; check the operating "
                   "point."},
    CatalogueEntry{VerdictCode::external_disturbance, "external_disturbance", 0.5, "oscillation",
                   Fault::disturbance, false, "Something outside the loop disturbs it",
                   "A disturbance reaches the loop from outside.",
                   "Find its source (feeds, utilities, another loop) before changing this "
                   "loop."},
    CatalogueEntry{VerdictCode::process_change, "process_change", 0.6, "oscillation",
                   Fault::process, false, "The process gain changed",
                   "The process has changed within the window.",
                   "Check what was changed at that time."},
    CatalogueEntry{VerdictCode::sensor_fault, "sensor_fault", 1.0, "sensor", Fault::sensor, true,
                   "The measurement is frozen, held or coarse",
                   "The measurement is not trustworthy.",
                   "Check transmitter, impulse lines and the archive's settings for this tag."},
    CatalogueEntry{VerdictCode::tight_tuning, "tight_tuning", 0.7, "oscillation", Fault::tuning,
                   false, "The controller is tuned too tightly", "The controller is too tight.",
                   "Lower the controller gain or slow the integral action; check that no valve "
                   "fault hides behind it."},
    CatalogueEntry{VerdictCode::sluggish_tuning, "sluggish_tuning", 0.4, "slowness", Fault::tuning,
                   false, "The controller is tuned too slowly",
                   "The loop corrects disturbances slowly.",
                   "Raise the controller gain or speed up the integral action in small steps."},
    CatalogueEntry{VerdictCode::nonlinear_unexplained, "nonlinear_unexplained", 0.5, "unknown",
                   Fault::unexplained, false, "Nonlinear, but no known effect explains it",
                   "The loop is nonlinear; its data alone do not show where.",
                   "Record the valve position (mv) or do a stroke test, then analyse again."},
    CatalogueEntry{VerdictCode::unexplained, "unexplained", 0.3, "unknown", Fault::unexplained,
                   false, "Structured, but no known effect explains it",
                   "Performance could be better; no cause was found.",
                   "Inspect the trends of setpoint, process variable and controller output."},
    CatalogueEntry{VerdictCode::not_controlling, "not_controlling", 0.0, "", Fault::none, false,
                   "No controller acts: manual, tracking, out of service, constant output",
                   "No controller acts on the loop.", "Ask operations why it is not in automatic."},
    CatalogueEntry{VerdictCode::insufficient_data, "insufficient_data", 0.0, "", Fault::none, false,
                   "The data cannot be judged", "The data cannot be judged.",
                   "Correct what the reason names, or wait until enough is recorded."},
};

constexpr bool in_order() {
  for (std::size_t k = 0; k < kCatalogue.size(); ++k)
    if (static_cast<std::size_t>(kCatalogue[k].code) != k) return false;
  return true;
}
static_assert(in_order());

/// That one of the causes is there which tell neighbours so.
double probability_of(plant::Fault blamed, const Verdict& verdict) {
  double none = 1.0;
  for (const CauseReport& cause : verdict.causes)
    if (catalogue_entry(cause.code).blames == blamed) none *= 1.0 - cause.probability;
  return 1.0 - none;
}

}  // namespace

std::span<const CatalogueEntry> catalogue() {
  return kCatalogue;
}

const CatalogueEntry& catalogue_entry(VerdictCode code) {
  return kCatalogue.at(static_cast<std::size_t>(code));
}

Verdict verdict_with(VerdictCode code, double confidence) {
  const CatalogueEntry& entry = catalogue_entry(code);
  return {code, confidence, std::string(entry.summary), {}, std::string(entry.action)};
}

plant::OwnFindings own_findings(const Verdict& verdict) {
  return {catalogue_entry(verdict.code).blames, verdict.confidence,
          probability_of(plant::Fault::friction, verdict),
          probability_of(plant::Fault::disturbance, verdict)};
}

}  // namespace loopscope::core::diagnosis
