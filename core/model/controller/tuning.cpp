#include "core/model/controller/tuning.hpp"

#include <cmath>

#include "core/model/controller/closed_loop.hpp"
#include "core/model/controller/simc.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Well tuned loops have Ms up to 2, those that oscillate 3.5 and more. A zero that the fit lacks
/// may lift 2 to 3 (paper, 5.1).
constexpr double kTightSensitivity = 3.0;
/// Of SIMC's integral action by the recorded one.
constexpr double kSluggish = 4.0;
/// Gain that a fit may have too much: with so much less, the loop of a bounded record is stable.
constexpr double kGainInDoubt = 0.5;

bool stable(const ClosedLoop& loop) {
  return std::isfinite(loop.peak_sensitivity);
}

bool contradicts(const ProcessFit& fit, const ControllerLaw& law, double interval_s) {
  ProcessFit weaker = fit;
  weaker.gain *= kGainInDoubt;
  return !stable(close_loop(weaker, law, interval_s));
}

Tuning decide(const ProcessFit& fit, const TuningJudgement& judged, bool contradictory) {
  if (contradictory) return Tuning::contradictory;
  if (!(judged.loop.peak_sensitivity <= kTightSensitivity)) return Tuning::tight;
  const bool slow = !fit.integrating && judged.slowness > kSluggish;
  return slow ? Tuning::sluggish : Tuning::fine;
}

std::string describe(const TuningJudgement& judged) {
  if (judged.tuning == Tuning::contradictory) {
    return "The loop that process and controller imply is unstable: the fit cannot be right.";
  }
  return text::sentence(
      "The implied loop has a peak sensitivity of ", judged.loop.peak_sensitivity,
      " and settles in ", judged.loop.settling_s, " s; tuned by the SIMC rules it would have ",
      judged.reference.peak_sensitivity, " and settle in ", judged.reference.settling_s, " s with ",
      judged.slowness, " times the integral action.");
}

}  // namespace

TuningJudgement judge_tuning(const ProcessFit& fit, const ControllerLaw& law, double interval_s) {
  const ControllerLaw simc = simc_law(fit, interval_s);
  TuningJudgement judged;
  judged.loop = close_loop(fit, law, interval_s);
  judged.reference = close_loop(fit, simc, interval_s);
  judged.slowness = law.integral != 0.0 ? simc.integral / law.integral : 0.0;
  judged.settling_ratio = judged.loop.settling_s / judged.reference.settling_s;
  const bool contradictory = !stable(judged.loop) && contradicts(fit, law, interval_s);
  judged.tuning = decide(fit, judged, contradictory);
  judged.statement = describe(judged);
  return judged;
}

}  // namespace loopscope::core::model
