#include "core/hos/analyse.hpp"

#include <cmath>
#include <stdexcept>

#include "core/hos/bicoherence.hpp"
#include "core/hos/indices.hpp"
#include "core/hos/moments.hpp"
#include "core/hos/peaks.hpp"
#include "core/hos/quadratic_test.hpp"
#include "core/hos/significance.hpp"
#include "core/hos/tested_spectra.hpp"

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
  }
  throw std::invalid_argument("higher-order statistics: unknown coupling");
}

PublishedDecision published_decision(double ngi, double nli, const Settings& settings) {
  const bool gaussian = ngi <= settings.ngi_threshold;
  return {gaussian, gaussian || nli <= settings.nli_threshold};
}

namespace {

/// Each kind that is significant by itself; where only both together are, the stronger one.
Coupling coupling_of(const Significance& found, double alpha) {
  if (found.nonlinear_p > alpha) return Coupling::none_found;
  const double cubic_p = found.cubic_p.value_or(1.0);
  if (found.quadratic_p <= alpha && cubic_p <= alpha) return Coupling::both;
  return found.quadratic_p <= cubic_p ? Coupling::quadratic : Coupling::cubic;
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
                 Result& result) {
  const Indices found = indices(bic2, segments, settings.alpha);
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

}  // namespace

std::optional<Result> analyse(std::span<const double> signal, const Settings& settings,
                              std::uint64_t seed, const Kernels& kernels) {
  Bicoherence bicoherence(settings, kernels);
  const std::span<const double> bic2 = bicoherence.estimate(signal);
  if (bic2.empty()) {
    return std::nullopt;
  }
  Result result;
  add_indices(bic2, bicoherence.segments(), settings, result);
  const Moments shape = moments(signal, kernels);
  result.skewness = shape.skewness;
  result.excess_kurtosis = shape.excess_kurtosis;
  result.peaks = find_peaks(bic2, bicoherence.segments(), settings);
  const TestedSpectra tested(signal, bicoherence, bic2, settings);
  add_peak_p(tested, result.peaks);
  const Significance found = measure_significance(tested, seed);
  result.ngi_p = found.ngi_p;
  result.nli_p = found.nli_p;
  result.cubic_p = found.cubic_p;
  result.nonlinear_p = found.nonlinear_p;
  result.coupling = coupling_of(found, settings.alpha);
  return result;
}

}  // namespace loopscope::core::hos
