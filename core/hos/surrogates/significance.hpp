#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/hos/coupling/tested_spectra.hpp"
#include "core/hos/linear/noise_shape.hpp"
#include "core/hos/surrogates/innovation_test.hpp"

namespace loopscope::core::hos {

/// p-values of one record, above 0 to 1; the question is the null hypothesis.
struct Significance {
  double ngi_p = 1.0;             ///< linear and Gaussian? mean squared bicoherence, first pass
  double nli_p = 1.0;             ///< linear, Gaussian or not? largest cell, and f + f -> 2f
  std::optional<double> cubic_p;  ///< linear? f + f + f -> 3f; nullopt = no period fits the record
  double quadratic_p = 1.0;       ///< linear? the first two combined, noise as it is
  double nonlinear_p = 1.0;       ///< linear? all combined: the one that decides
  std::optional<double> period_samples;      ///< at which harmonics were taken
  std::optional<NoiseShape> noise;           ///< nullopt = the record has no linear model
  std::optional<InnovationTest> innovation;  ///< of the second pass; nullopt = none was needed
  std::size_t surrogates = 0;                ///< drawn in the second pass
};

/// Two passes. The first is closed forms against Gaussian noise of whatever spectrum
/// (coupling_tests.hpp) and decides alone where nothing is near significance, or where the record's
/// innovations look like normal noise of one loudness (noise_shape.hpp). Else the noise may be
/// skewed, heavy-tailed or bursty, which a linear loop passes on: a finding stands only if it
/// stands out from surrogates that have the same (surrogates.hpp), of each kind that the
/// innovations call for; and the innovations are asked whether they depend on the past
/// (innovation_test.hpp).
///
/// `settings` are those of the published estimate. The same seed gives the same figures on one
/// processor path.
[[nodiscard]] Significance measure_significance(const TestedSpectra& tested,
                                                const Settings& settings, std::uint64_t seed);

}  // namespace loopscope::core::hos
