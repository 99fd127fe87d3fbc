#include "core/hos/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/bicoherence/indices.hpp"
#include "core/hos/bicoherence/moments.hpp"
#include "core/hos/bicoherence/peaks.hpp"
#include "core/hos/coupling/quadratic_test.hpp"
#include "core/hos/coupling/tested_spectra.hpp"
#include "core/hos/surrogates/significance.hpp"

namespace loopscope::core::hos {

std::string_view name(Coupling coupling) {
  switch (coupling) {
    case Coupling::none_found:
      return "none_found";
    case Coupling::quadratic:
      return "quadratic";
    case Coupling::cubic:
      return "cubic";
    case Coupling::both:
      return "both";
    case Coupling::too_short:
      return "too_short";
  }
  throw std::invalid_argument("higher-order statistics: unknown coupling");
}

PublishedDecision published_decision(double ngi, double nli, const Settings& settings) {
  const bool gaussian = ngi <= settings.ngi_threshold;
  return {gaussian, gaussian || nli <= settings.nli_threshold};
}

namespace {

/// Each kind that is significant by itself; where only all together are, the stronger one. Where no
/// phases are coupled the innovations say it: what they owe to squares of the past is quadratic,
/// what they owe to cubes is cubic.
Coupling coupling_of(const Significance& found, double alpha) {
  if (found.nonlinear_p > alpha) return Coupling::none_found;
  double quadratic_p = found.quadratic_p;
  double cubic_p = found.cubic_p.value_or(1.0);
  if (std::min(quadratic_p, cubic_p) > alpha && found.innovation) {
    quadratic_p = std::min(quadratic_p, found.innovation->even_p);
    cubic_p = std::min(cubic_p, found.innovation->odd_p);
  }
  if (quadratic_p <= alpha && cubic_p <= alpha) return Coupling::both;
  return quadratic_p <= cubic_p ? Coupling::quadratic : Coupling::cubic;
}

Bifrequency bins_of(const Peak& peak, const Settings& settings) {
  const auto bins = static_cast<double>(settings.dft_length);
  return {static_cast<std::size_t>(std::lround(peak.f1 * bins)),
          static_cast<std::size_t>(std::lround(peak.f2 * bins))};
}

void add_peak_p(const TestedSpectra& tested, std::vector<Peak>& peaks) {
  if (tested.bic2().empty() || peaks.empty()) return;
  const QuadraticTest test(tested.settings());
  for (Peak& peak : peaks) {
    peak.p = test.peak_p(tested.bicoherence(), bins_of(peak, tested.settings()));
  }
}

void add_indices(std::span<const double> bic2, std::size_t segments, const Settings& settings,
                 const Kernels& kernels, Result& result) {
  const Indices found = indices(bic2, segments, settings.alpha, kernels);
  result.segments = segments;
  result.bifrequencies = bic2.size();
  result.mean_bic2 = found.mean_bic2;
  result.std_bic2 = found.std_bic2;
  result.max_bic2 = found.max_bic2;
  result.critical_mean_bic2 = found.critical_mean_bic2;
  result.ngi = found.ngi;
  result.nli = found.nli;
  result.published = published_decision(found.ngi, found.nli, settings);
}

/// Everything but the tests.
std::optional<Result> describe(std::span<const double> signal, std::span<const double> bic2,
                               std::size_t segments, const Settings& settings,
                               const Kernels& kernels) {
  if (bic2.empty()) return std::nullopt;
  Result result;
  add_indices(bic2, segments, settings, kernels, result);
  const Moments shape = moments(signal, kernels);
  result.skewness = shape.skewness;
  result.excess_kurtosis = shape.excess_kurtosis;
  return result;
}

void add_tests(std::span<const double> signal, const Bicoherence& bicoherence,
               std::span<const double> bic2, const Settings& settings, std::uint64_t seed,
               Result& result) {
  result.peaks = find_peaks(bic2, bicoherence.segments(), settings);
  const TestedSpectra tested(signal, bicoherence, bic2, settings);
  add_peak_p(tested, result.peaks);
  const Significance found = measure_significance(tested, settings, seed);
  result.ngi_p = found.ngi_p;
  result.nli_p = found.nli_p;
  result.cubic_p = found.cubic_p;
  result.nonlinear_p = found.nonlinear_p;
  if (found.innovation) result.innovation_p = found.innovation->p();
  result.noise = found.noise;
  result.coupling = coupling_of(found, settings.alpha);
}

}  // namespace

std::optional<Result> analyse(std::span<const double> signal, const Settings& settings,
                              std::uint64_t seed, const Kernels& kernels) {
  Bicoherence bicoherence(settings, kernels);
  const std::span<const double> bic2 = bicoherence.estimate(signal);
  auto result = describe(signal, bic2, bicoherence.segments(), settings, kernels);
  if (result) add_tests(signal, bicoherence, bic2, settings, seed, *result);
  return result;
}

std::optional<Result> analyse(std::span<const double> signal, std::span<const double> tested,
                              const Settings& settings, std::uint64_t seed,
                              const Kernels& kernels) {
  Bicoherence bicoherence(settings, kernels);
  std::span<const double> bic2 = bicoherence.estimate(signal);
  auto result = describe(signal, bic2, bicoherence.segments(), settings, kernels);
  if (!result) return result;
  bic2 = bicoherence.estimate(tested);
  if (!bic2.empty()) add_tests(tested, bicoherence, bic2, settings, seed, *result);
  return result;
}

}  // namespace loopscope::core::hos
