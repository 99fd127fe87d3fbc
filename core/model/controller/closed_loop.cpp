#include "core/model/controller/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/model/controller/polynomial_zeros.hpp"
#include "core/model/controller/sensitivity_peak.hpp"

namespace loopscope::core::model {
namespace {

using Complex = std::complex<double>;

/// Eigenvalues of larger matrices cost more than the rest of the analysis (cubic in the delay).
constexpr std::size_t kMostDelay = 25;
/// Poles this close to the unit circle are on it: rounding moves them by about so much.
constexpr double kOnCircle = 1e-7;
/// Well tuned loops stay below; above it the pair that makes the peak is what shows of the loop.
constexpr double kResonant = 2.0;
/// An integral time below this share of a sample cannot be told from pure integral action, and 0
/// would read as none.
constexpr double kShortestIntegralTime = 0.01;

Polynomial delayed(const Polynomial& polynomial, std::size_t samples) {
  Polynomial result(samples, 0.0);
  result.insert(result.end(), polynomial.begin(), polynomial.end());
  return result;
}

/// The controller without its lag: numerator over 1 - z^-1, or over 1 without integral action.
Polynomial controller_numerator(const ControllerLaw& law) {
  if (law.integral == 0.0) return {law.gain + law.derivative, -law.derivative};
  return {law.gain + law.integral + law.derivative, -law.gain - 2.0 * law.derivative,
          law.derivative};
}

Polynomial controller_denominator(const ControllerLaw& law) {
  return law.integral == 0.0 ? Polynomial{1.0} : Polynomial{1.0, -1.0};
}

bool integrates(const SampledProcess& process) {
  return std::abs(value(process.denominator, 1.0)) < kOnCircle;
}

/// Numerator of pv's answer to a step of the load, over the characteristic polynomial.
Polynomial answer_to_load(const SampledProcess& process) {
  return integrates(process) ? process.numerator : process.denominator;
}

/// Energy of a pole's part of the answer: |residue|^2 / (1 - |pole|^2).
double energy(Complex pole, const Polynomial& answer, const std::vector<Complex>& poles) {
  Complex residue = value(answer, 1.0 / pole);
  for (const Complex& other : poles) {
    if (other != pole) residue /= 1.0 - other / pole;
  }
  return std::norm(residue) / (1.0 - std::norm(pole));
}

Complex nearest(Complex place, const std::vector<Complex>& poles) {
  return *std::ranges::min_element(poles, {},
                                   [&](const Complex& pole) { return std::norm(pole - place); });
}

Complex dominant(const std::vector<Complex>& poles, const Polynomial& answer) {
  return *std::ranges::max_element(
      poles, {}, [&](const Complex& pole) { return energy(pole, answer, poles); });
}

/// Damping and period of a pair of poles; a positive real pole has damping 1 and no period.
void describe_pole(Complex pole, double interval_s, ClosedLoop& loop) {
  const Complex s = std::log(pole);
  const bool oscillates = std::abs(s.imag()) > kOnCircle;
  loop.damping = oscillates ? -s.real() / std::abs(s) : (s.real() < 0.0 ? 1.0 : -1.0);
  loop.period_s = oscillates ? 2.0 * std::numbers::pi / std::abs(s.imag()) * interval_s : 0.0;
}

/// The loop seen every `factor` samples.
ControllerLaw coarser(ControllerLaw law, double factor) {
  law.integral *= factor;
  law.derivative /= factor;
  return law;
}

double integral_time(const ControllerLaw& law, double interval_s) {
  if (law.integral == 0.0) return 0.0;
  return std::max(law.gain / law.integral, kShortestIntegralTime) * interval_s;
}

}  // namespace

Polynomial characteristic(const SampledProcess& process, const ControllerLaw& law) {
  const Polynomial open = product(process.denominator, controller_denominator(law));
  const Polynomial back = product(process.numerator, controller_numerator(law));
  return sum(open, delayed(back, process.delay_samples + law.lag));
}

ClosedLoop close_loop(const SampledProcess& process, const ControllerLaw& law, double interval_s) {
  if (!(interval_s > 0.0)) throw std::invalid_argument("closed loop: interval has to be > 0");
  ClosedLoop loop;
  loop.controller_gain = law.gain;
  loop.integral_time_s = integral_time(law, interval_s);
  loop.integral_per_s = law.integral / interval_s;
  loop.controller_fit = law.explained;
  const std::vector<Complex> poles = zeros(characteristic(process, law));
  const Complex slowest =
      poles.empty() ? Complex{} : *std::ranges::max_element(poles, {}, [](const Complex& pole) {
        return std::abs(pole);
      });
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  constexpr double kTwoPercent = 0.02;
  if (std::abs(slowest) >= 1.0 - kOnCircle) {
    loop.peak_sensitivity = loop.settling_s = kInfinite;
    describe_pole(slowest, interval_s, loop);
    return loop;
  }
  const SensitivityPeak peak = find_sensitivity_peak(process, law);
  loop.peak_sensitivity = peak.value;
  if (poles.empty()) return loop;
  loop.settling_s = std::log(kTwoPercent) / std::log(std::abs(slowest)) * interval_s;
  const Complex shown = peak.value > kResonant ? nearest(std::polar(1.0, peak.frequency), poles)
                                               : dominant(poles, answer_to_load(process));
  describe_pole(shown, interval_s, loop);
  return loop;
}

ClosedLoop close_loop(const ProcessFit& fit, const ControllerLaw& law, double interval_s) {
  const double factor = std::max(1.0, std::ceil(fit.delay_s / (interval_s * kMostDelay)));
  ClosedLoop loop = close_loop(sample_process(fit, factor * interval_s), coarser(law, factor),
                               factor * interval_s);
  loop.integral_time_s = integral_time(law, interval_s);
  return loop;
}

}  // namespace loopscope::core::model
