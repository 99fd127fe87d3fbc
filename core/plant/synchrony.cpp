#include "core/plant/synchrony.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/plant/correlation_p.hpp"
#include "core/plant/prewhitening.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFewestKnown = 8;
/// A degree of freedom has gone to the own past of each of two series.
constexpr double kOwnPasts = 2.0;
/// Controllers that are tuned by one rule may cycle at the same frequency by more than chance.
constexpr double kLeastFrequencyP = 0.02;

bool known(Complex z) {
  return std::isfinite(z.real()) && std::abs(z) > 0.0;
}

std::vector<double> phase_steps(const Envelope& envelope) {
  std::vector<double> steps(envelope.points.size(), signal::kMissing);
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const Complex turn = Complex(envelope.points[k]) * std::conj(Complex(envelope.points[k - 1]));
    if (known(turn)) steps[k] = std::arg(turn);
  }
  return steps;
}

std::vector<double> magnitudes(const Envelope& envelope) {
  std::vector<double> sizes(envelope.points.size(), signal::kMissing);
  std::ranges::transform(envelope.points, sizes.begin(),
                         [](Complex z) { return known(z) ? std::abs(z) : signal::kMissing; });
  return sizes;
}

/// Products of one envelope with the conjugate of the other, of size 1, with their places.
struct Products {
  std::vector<double> at;
  std::vector<Complex> turns;
};

Products multiply(const Envelope& one, const Envelope& other) {
  Products products;
  const std::int64_t from = std::max(one.first, other.first);
  const std::int64_t to = std::min(one.end(), other.end());
  for (std::int64_t j = from; j < to; ++j) {
    const Complex product = one.at(j) * std::conj(other.at(j));
    if (!known(product)) continue;
    products.at.push_back(static_cast<double>(j - from));
    products.turns.push_back(product / std::abs(product));
  }
  return products;
}

constexpr int kSteps = 20;  ///< of slowest_turn to either side, a tenth of a resolution each

/// Periodogram at kSteps tenths of a resolution to either side of 0.
std::array<double, 2 * kSteps + 1> power_about_zero(const Products& products, double duration) {
  std::array<Complex, 2 * kSteps + 1> sums{};
  for (std::size_t k = 0; k < products.at.size(); ++k) {
    const Complex step = std::polar(1.0, -0.2 * std::numbers::pi * products.at[k] / duration);
    Complex turned = 1.0;
    sums[kSteps] += products.turns[k];
    for (std::size_t i = 1; i <= kSteps; ++i) {
      turned *= step;
      sums[kSteps + i] += products.turns[k] * turned;
      sums[kSteps - i] += products.turns[k] * std::conj(turned);
    }
  }
  std::array<double, 2 * kSteps + 1> power{};
  std::ranges::transform(sums, power.begin(), [](Complex sum) { return std::norm(sum); });
  return power;
}

/// |D| T: the peak of the product's periodogram within two resolutions, in resolutions.
double slowest_turn(const Products& products) {
  const double duration = products.at.back() - products.at.front() + 1.0;
  const auto power = power_about_zero(products, duration);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(power) - power.begin());
  if (best == 0 || best + 1 == power.size()) return 2.0;
  const double left = power[best - 1], middle = power[best], right = power[best + 1];
  const double shift = 0.5 * (left - right) / (left - 2.0 * middle + right);
  return std::abs(0.1 *
                  (static_cast<double>(best) - kSteps + (std::isfinite(shift) ? shift : 0.0)));
}

/// One-sided p of the correlation of `one` with `other` so many points later.
double moves_together_p(const Increments& a, const std::vector<double>& one, const Increments& b,
                        const std::vector<double>& other, std::int64_t later) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const std::int64_t j =
        a.envelope.first + static_cast<std::int64_t>(k) + later - b.envelope.first;
    if (j < 0 || j >= static_cast<std::int64_t>(other.size())) continue;
    const double value = other[static_cast<std::size_t>(j)];
    if (!std::isfinite(one[k]) || !std::isfinite(value)) continue;
    x.push_back(one[k]);
    y.push_back(value);
  }
  return correlation_p(x, y, kOwnPasts);
}

double together_p(const Increments& a, const Increments& b, std::vector<double> Increments::*part) {
  double best = 1.0;
  for (const std::int64_t later : {-1, 0, 1})
    best = std::min(best, moves_together_p(a, a.*part, b, b.*part, later));
  return std::min(1.0, 3.0 * best);
}

}  // namespace

Increments measure_increments(Envelope envelope) {
  Increments increments;
  increments.phase = without_own_past(phase_steps(envelope));
  increments.amplitude = without_own_past(magnitudes(envelope));
  increments.envelope = std::move(envelope);
  return increments;
}

Synchrony compare(const Increments& one, const Increments& other) {
  Synchrony result;
  const Products products = multiply(one.envelope, other.envelope);
  result.points = products.at.size();
  if (result.points < kFewestKnown) return result;
  result.frequency_p = std::clamp(slowest_turn(products), kLeastFrequencyP, 1.0);
  result.phase_p = together_p(one, other, &Increments::phase);
  result.amplitude_p = together_p(one, other, &Increments::amplitude);
  const double all =
      fisher_combined_p(std::array{result.frequency_p, result.phase_p, result.amplitude_p});
  result.p = std::min(1.0, 2.0 * std::min(all, result.frequency_p));
  return result;
}

}  // namespace loopscope::core::plant
