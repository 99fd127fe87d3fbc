#include "core/model/controller/inverse_controller_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/controller/octave_power.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Right models of healthy, moving, disturbed, tight, sluggish and integrating loops, 20 % off in
/// gain and time constant, keep a distance of 0.8 and more; the inverse law itself has 0.
constexpr double kRefusedBelow = 0.5;
/// Frequencies an octave: a resonance is narrower than its octave, and G = -1/C there in any tight
/// loop. Between its flanks only the controller run backwards matches.
constexpr int kPerOctave = 4;

double distance_to_inverse(const SampledProcess& fit, const ControllerLaw& law,
                           const std::vector<OctavePower>& octaves) {
  double apart = 0.0, larger = 0.0;
  for (const OctavePower& octave : octaves) {
    for (int i = 0; i < kPerOctave; ++i) {
      const double w = octave.low * std::exp2((i + 0.5) / kPerOctave);
      const std::complex<double> process = response(fit, w);
      const std::complex<double> inverse = -1.0 / response(law, w);
      apart += octave.share * std::norm(process - inverse);
      larger += octave.share * std::max(std::norm(process), std::norm(inverse));
    }
  }
  return larger > 0.0 ? std::min(1.0, std::sqrt(apart / larger)) : 1.0;
}

/// Sign of the loop's gain where integral action (or, without it, the gain) rules: slowly.
bool positive_feedback(const SampledProcess& fit, const ControllerLaw& law) {
  double slow_gain = 0.0;
  for (const double b : fit.numerator) slow_gain += b;
  return slow_gain * (law.integral != 0.0 ? law.integral : law.gain) < 0.0;
}

std::string describe(const InverseControllerFit& trap) {
  if (!trap.refused) return {};
  if (trap.distance < kRefusedBelow) {
    return text::sentence("The fit from op to pv is the controller run backwards (distance ",
                          trap.distance, " of 1).");
  }
  return "The fitted process would make positive feedback with the recorded controller.";
}

}  // namespace

InverseControllerFit judge_inverse_controller_fit(const SampledProcess& fit,
                                                  const ControllerLaw& law,
                                                  std::span<const double> op) {
  InverseControllerFit trap;
  const std::vector<OctavePower> octaves = octave_powers(op);
  if (!law.found || octaves.empty()) return trap;
  trap.distance = distance_to_inverse(fit, law, octaves);
  trap.wrong_sign = positive_feedback(fit, law);
  trap.refused = trap.wrong_sign || trap.distance < kRefusedBelow;
  trap.statement = describe(trap);
  return trap;
}

InverseControllerFit judge_inverse_controller_fit(const ProcessFit& fit, const ControllerLaw& law,
                                                  std::span<const double> op, double interval_s) {
  return judge_inverse_controller_fit(sample_process(fit, interval_s), law, op);
}

}  // namespace loopscope::core::model
