#include "core/loop/harris_p.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "core/hos/numeric/distributions.hpp"
#include "core/loop/real_transform.hpp"

namespace loopscope::core::loop {
namespace {

/// A fitted model forgets faster than the process behind it; with the full degrees of freedom twice
/// to five times the nominal share of records at the edge of the null were rejected (DECISIONS.md).
constexpr double kTrustInMemory = 0.7;

/// Independent values among `samples` of noise with this impulse response, where its variance is
/// estimated. By Parseval, sum of rho(k)^2 is the mean square of its power spectrum over the
/// squared mean.
double degrees_of_freedom(std::span<const double> psi, double samples) {
  RealTransform transform(fast_length(2 * psi.size()));
  const RealTransform::Spectrum spectrum = transform.forward({psi.begin(), psi.end()});
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const bool own_mirror = i == 0 || i + 1 == spectrum.size();
    const double weight = own_mirror ? 1.0 : 2.0;
    const double power = std::norm(spectrum[i]);
    sum += weight * power;
    squares += weight * power * power;
  }
  return kTrustInMemory * samples * sum * sum / (static_cast<double>(transform.length()) * squares);
}

double odds_of_slow(double index) {
  return (1.0 - index) / index;
}

}  // namespace

double harris_p(double middle, const ArModel& model, std::size_t delay, double samples) {
  const auto length = static_cast<std::size_t>(samples);
  if (middle >= kWellTunedHarris || length <= delay) return 1.0;
  const std::vector<double> response = impulse_response(model, length);
  const std::span<const double> psi(response);
  const double slow = degrees_of_freedom(psi.subspan(delay), samples);
  const double fast = degrees_of_freedom(psi.first(delay), samples);
  const double ratio = odds_of_slow(middle) / odds_of_slow(kWellTunedHarris);
  const double p = hos::f_upper(ratio, slow, fast);
  return std::isfinite(p) ? p : 1.0;
}

}  // namespace loopscope::core::loop
