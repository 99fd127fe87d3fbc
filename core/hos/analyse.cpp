#include "core/hos/analyse.hpp"

#include <stdexcept>

#include "core/hos/bicoherence.hpp"
#include "core/hos/indices.hpp"
#include "core/hos/moments.hpp"
#include "core/hos/peaks.hpp"

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

std::optional<Result> analyse(std::span<const double> signal, const Settings& settings) {
  Bicoherence bicoherence(settings);
  const std::span<const double> bic2 = bicoherence.estimate(signal);
  if (bic2.empty()) {
    return std::nullopt;
  }
  const Indices found = indices(bic2, bicoherence.segments(), settings.alpha);
  const Moments shape = moments(signal);
  Result result;
  result.segments = bicoherence.segments();
  result.bifrequencies = bic2.size();
  result.mean_bic2 = found.mean_bic2;
  result.std_bic2 = found.std_bic2;
  result.max_bic2 = found.max_bic2;
  result.critical_mean_bic2 = found.critical_mean_bic2;
  result.ngi = found.ngi;
  result.nli = found.nli;
  result.published = published_decision(found.ngi, found.nli, settings);
  result.skewness = shape.skewness;
  result.excess_kurtosis = shape.excess_kurtosis;
  result.peaks = find_peaks(bic2, bicoherence.segments(), settings);
  // Skewed noise through a linear filter passes both published thresholds; without a peak that
  // stands out there is nothing to call coupling.
  const bool coupled = !result.published.linear && !result.peaks.empty();
  result.coupling = coupled ? Coupling::quadratic : Coupling::none_found;
  return result;
}

}  // namespace loopscope::core::hos
