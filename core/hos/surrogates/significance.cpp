#include "core/hos/surrogates/significance.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/hos/coupling/combine_p.hpp"
#include "core/hos/coupling/coupling_tests.hpp"
#include "core/hos/numeric/magnitude.hpp"
#include "core/hos/slow/period.hpp"
#include "core/hos/surrogates/locked_harmonics.hpp"
#include "core/hos/surrogates/slow_wander.hpp"
#include "core/hos/surrogates/surrogate_test.hpp"
#include "core/hos/surrogates/surrogates.hpp"

namespace loopscope::core::hos {
namespace {

/// First-pass p-values above this decide nothing, whatever the noise.
constexpr double kUnclear = 0.05;
/// A figure of the innovations below this calls for the surrogates that have the same. Of records
/// with normal noise one in 25 has one; they only take longer.
constexpr double kCalls = 0.01;

/// The figure that calls for a kind of surrogates. Heavy tails are kept by both kinds; random signs
/// are enough where nothing is skewed.
double call_p(Null null, const NoiseShape& noise) {
  return null == Null::random_signs ? std::min(noise.tails_p, noise.variance_p)
                                    : std::min(noise.skewness_p, noise.light_tails_p);
}

/// The kinds that are called for, the more urgent first. Each is asked about the p that the one
/// before has let stand, not about the first pass's: noise that is skewed and changes its loudness,
/// or has a line beside it, is kept whole by neither, and asked about the first pass's p both would
/// call it nonlinear (DECISIONS.md).
std::vector<Null> nulls_for(const NoiseShape& noise) {
  const double signs = call_p(Null::random_signs, noise);
  const double order = call_p(Null::permuted, noise);
  std::vector<Null> nulls;
  if (signs < kCalls) nulls.push_back(Null::random_signs);
  if (order < kCalls) nulls.insert(order < signs ? nulls.begin() : nulls.end(), Null::permuted);
  return nulls;
}

/// Everything that surrogates are drawn and tested with.
struct SecondPass {
  std::vector<double> signal;  // samples of 1e300 would overflow when squared
  const TestedSpectra& tested;
  const Settings& settings;
  const HarmonicTest* harmonics;
  std::optional<double> period;
  std::uint64_t seed;
  double scatter = 1.0;  // of the innovations' scale
  std::size_t surrogates = 0;

  [[nodiscard]] const Kernels& kernels() const { return tested.kernels(); }

  /// By weighted least squares, of no higher order than the noise allows to know.
  [[nodiscard]] std::optional<Innovations> fit(std::span<const double> record) const {
    OrderChoice order;
    order.penalty *= scatter;
    const auto fitted = Innovations::of(record, kernels(), order);
    if (!fitted) return std::nullopt;
    return fitted->reweighted(record, kernels());
  }

  /// What the surrogates are to be like: the record, less its harmonics where these are in
  /// question.
  [[nodiscard]] std::vector<double> uncoupled(const CouplingTests& found) const {
    const bool in_question = std::min(found.nli_p, found.cubic_p.value_or(1.0)) < kUnclear;
    return period && in_question ? without_locked_harmonics(signal, *period) : signal;
  }

  CouplingTests held(const CouplingTests& found, std::span<const double> record,
                     const Innovations& innovations, Null null) {
    Surrogates source(record, innovations, null, seed);
    Bicoherence workspace(settings, kernels());
    std::vector<double> drawn;
    return against_surrogates(found, kUnclear, [&](bool at_harmonics) {
      source.draw(drawn);
      ++surrogates;
      return test_coupling(TestedSpectra(drawn, workspace, settings),
                           at_harmonics ? harmonics : nullptr);
    });
  }
};

void fill(const CouplingTests& tests, Significance& result) {
  result.nli_p = tests.nli_p;
  result.cubic_p = tests.cubic_p;
  result.quadratic_p = tests.quadratic();
  result.nonlinear_p = tests.combined();
}

void second_pass(SecondPass& pass, CouplingTests tests, Significance& result) {
  const std::vector<double> record = pass.uncoupled(tests);
  const std::optional<Innovations> innovations = pass.fit(record);
  if (!innovations) return;
  const std::vector<Null> nulls = nulls_for(noise_shape(*innovations, pass.kernels()));
  if (nulls.empty()) return;
  for (const Null null : nulls) {
    if (tests.smallest() < kUnclear) tests = pass.held(tests, record, *innovations, null);
  }
  fill(tests, result);
  const std::vector<double> steady = without_slow_wander(pass.signal);
  const std::optional<Innovations> coupled = pass.fit(steady);
  if (coupled) result.innovation = test_innovations(steady, *coupled);
  const double innovation_p = result.innovation ? result.innovation->p() : 1.0;
  result.nonlinear_p = combine_p(std::array{result.nonlinear_p, innovation_p});
  result.surrogates = pass.surrogates;
}

}  // namespace

Significance measure_significance(const TestedSpectra& tested, const Settings& settings,
                                  std::uint64_t seed) {
  Significance result;
  const std::optional<double> period = dominant_period(tested.signal(), tested.kernels());
  std::optional<HarmonicTest> harmonics;
  if (period) harmonics.emplace(*period);
  const HarmonicTest* const at_period = harmonics ? &*harmonics : nullptr;
  const CouplingTests tests = test_coupling(tested, at_period);
  result.ngi_p = tests.mean_p;
  fill(tests, result);
  if (tests.cubic_p) result.period_samples = period;
  SecondPass pass{scaled_to_unit(tested.recorded()), tested, settings, at_period, period, seed};
  // Tells the shape of the noise well enough: sums of normal values are normal.
  constexpr OrderChoice kRough = {.largest = 8};
  const auto innovations = Innovations::of(pass.signal, tested.kernels(), kRough);
  if (!innovations) return result;
  result.noise = noise_shape(*innovations, tested.kernels());
  pass.scatter = innovations->scatter();
  if (tests.smallest() < kUnclear) second_pass(pass, tests, result);
  return result;
}

}  // namespace loopscope::core::hos
