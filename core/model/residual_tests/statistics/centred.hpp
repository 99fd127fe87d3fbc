#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// A signal about its mean in units of its standard deviation, with 0 where it is missing: sums of
/// products then run over what is recorded without asking.
struct Centred {
  std::vector<double> values;
  std::size_t recorded = 0;
  double mean = 0.0;  ///< signal units
  double std = 1.0;   ///< signal units
};

/// nullopt when fewer than `fewest` samples are finite or they do not vary beyond rounding.
[[nodiscard]] std::optional<Centred> centred(std::span<const double> signal, std::size_t fewest);

/// Samples over which high_passed() forgets. op answers to past residuals, so that a feature of op
/// that wanders slower than the record is long enough for does not average out
/// (core/model/residual_tests/README.md); what a valve or a bend does within a few dozen samples of
/// a move is kept.
inline constexpr double kMemorySamples = 40.0;

/// signal(k) less its exponential mean before k: what the past alone decides, as the tests that
/// regress on it need. Missing samples stay NaN.
[[nodiscard]] std::vector<double> high_passed(std::span<const double> signal);

/// The finite samples, ascending.
[[nodiscard]] std::vector<double> sorted_finite(std::span<const double> signal);

/// signal(k) - signal(k - 1); NaN where either is missing and at the first sample.
[[nodiscard]] std::vector<double> increments(std::span<const double> signal);

}  // namespace loopscope::core::model
