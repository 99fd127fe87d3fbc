#pragma once

#include <cstdint>
#include <optional>

#include "core/hos/tested_spectra.hpp"

namespace loopscope::core::hos {

/// p-values of one record.
struct Significance {
  double ngi_p = 1.0;             ///< linear and Gaussian? mean squared bicoherence
  double nli_p = 1.0;             ///< linear, Gaussian or not? largest cell, and f + f -> 2f
  std::optional<double> cubic_p;  ///< linear? f + f + f -> 3f; nullopt = no period fits the record
  double quadratic_p = 1.0;       ///< linear? the first two combined, noise as it is
  double nonlinear_p = 1.0;       ///< linear? all three combined: the one that decides
  std::optional<double> period_samples;  ///< at which harmonics were taken
  bool second_pass = false;              ///< the loop's own noise was looked at by simulation
};

/// Two passes. The first is closed forms against Gaussian noise of whatever spectrum
/// (quadratic_test.hpp, harmonic_test.hpp) and decides alone where nothing is near significance, or
/// where the residuals of the record's linear model are Gaussian in their core. Else the noise may
/// be skewed or heavy-tailed, which a linear loop passes on: the second pass draws records of the
/// linear model with that noise, and each statistic's tail is fitted on them. A p-value is never
/// smaller than the first pass says.
///
/// The same seed gives the same figures on one processor path.
[[nodiscard]] Significance measure_significance(const TestedSpectra& tested, std::uint64_t seed);

}  // namespace loopscope::core::hos
