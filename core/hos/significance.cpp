#include "core/hos/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/hos/combine_p.hpp"
#include "core/hos/linear_model.hpp"
#include "core/hos/magnitude.hpp"
#include "core/hos/null_laws.hpp"
#include "core/hos/replicates.hpp"

namespace loopscope::core::hos {
namespace {

/// First-pass p-values above this decide nothing, whatever the noise.
constexpr double kUnclear = 0.05;

double combine(double mean_p, double largest_p, std::optional<double> cubic_p) {
  const std::array all{mean_p, largest_p, cubic_p.value_or(1.0)};
  return combine_p(std::span(all).first(cubic_p ? 3 : 2));
}

/// The answer for noise that may be the model's or Gaussian with events: in the middle, on a
/// logarithmic scale, where its core does not tell.
double settle(double gaussian_p, double noise_p, ResidualNoise::Core core) {
  const double p =
      core == ResidualNoise::Core::undecided ? std::sqrt(gaussian_p) * std::sqrt(noise_p) : noise_p;
  return std::max(gaussian_p, p);
}

}  // namespace

SignificanceTest::SignificanceTest(const Settings& settings)
    : settings_(settings), quadratic_(settings) {}

Significance SignificanceTest::measure(std::span<const double> signal,
                                       const Bicoherence& bicoherence, std::span<const double> bic2,
                                       std::uint64_t seed) const {
  const Statistics found{quadratic_.measure(bicoherence, bic2), bicoherence.segments(),
                         cubic_statistics(signal)};
  Significance result;
  result.ngi_p = quadratic_.mean_p(found.quadratic, found.segments);
  result.nli_p = quadratic_.largest_p(found.quadratic);
  if (found.cubic) {
    result.cubic_p = p_of_evidence(found.cubic->evidence);
    result.period_samples = found.cubic->period_samples;
  }
  result.quadratic_p = combine(result.ngi_p, result.nli_p, std::nullopt);
  result.nonlinear_p = combine(result.ngi_p, result.nli_p, result.cubic_p);
  if (std::min({result.ngi_p, result.nli_p, result.cubic_p.value_or(1.0)}) < kUnclear) {
    second_pass(signal, found, seed, result);
  }
  return result;
}

void SignificanceTest::second_pass(std::span<const double> signal, const Statistics& found,
                                   std::uint64_t seed, Significance& result) const {
  // The model's squares would overflow or vanish for samples of 1e300 or 1e-300.
  const std::optional<LinearModel> model = LinearModel::fit(scaled_to_unit(signal));
  if (!model || model->noise().core() == ResidualNoise::Core::gaussian) return;
  const Replicates drawn(*model, signal, settings_, quadratic_, result.period_samples, seed);
  const ResidualNoise::Core core = model->noise().core();
  const double mean_p = drawn.mean_p(found.quadratic.mean);
  const double largest_p = drawn.largest_p(result.nli_p);
  std::optional<double> cubic_p;
  if (result.cubic_p) cubic_p = drawn.cubic_p(*result.cubic_p);

  result.second_pass = true;
  result.quadratic_p = settle(result.quadratic_p, combine(mean_p, largest_p, std::nullopt), core);
  result.nonlinear_p = settle(result.nonlinear_p, combine(mean_p, largest_p, cubic_p), core);
  result.nli_p = settle(result.nli_p, largest_p, core);
  if (cubic_p) result.cubic_p = settle(*result.cubic_p, *cubic_p, core);
}

}  // namespace loopscope::core::hos
