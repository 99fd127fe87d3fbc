#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/hos/bicoherence/peaks.hpp"
#include "core/hos/kernels/kernels.hpp"
#include "core/hos/linear/noise_shape.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// What the error signal couples; `none_found` never means "linear", `too_short` that the record
/// holds too few cycles of its oscillation for any to be found.
enum class Coupling { none_found, quadratic, cubic, both, too_short };
[[nodiscard]] std::string_view name(Coupling coupling);

/// The paper's decision (section 3, "Practical implementation").
struct PublishedDecision {
  bool gaussian = true;  ///< NGI <= ngi_threshold
  bool linear = true;    ///< gaussian, or NLI <= nli_threshold
};

/// The decision at the thresholds of `settings`, the paper's beta = 0.001 and 0.01 by default.
/// What it does on linear signals is measured in core/hos/MEASURED.md.
[[nodiscard]] PublishedDecision published_decision(double ngi, double nli,
                                                   const Settings& settings);

/// Indices of one error signal.
struct Result {
  std::size_t segments = 0;         ///< K: segments without a missing sample
  std::size_t bifrequencies = 0;    ///< L: bifrequencies of the principal domain
  double mean_bic2 = 0.0;           ///< mean squared bicoherence over the domain, 0 to 1
  double std_bic2 = 0.0;            ///< its population standard deviation
  double max_bic2 = 0.0;            ///< its maximum
  double critical_mean_bic2 = 0.0;  ///< (c + sqrt(4L - 1))^2 / (4KL), eq. 11
  double ngi = 0.0;                 ///< non-Gaussianity index, eq. 12
  double nli = 0.0;                 ///< nonlinearity index, eq. 14
  PublishedDecision published;
  double skewness = 0.0;         ///< of the whole record
  double excess_kurtosis = 0.0;  ///< of the whole record
  std::optional<double> ngi_p, nli_p, cubic_p,
      nonlinear_p;  ///< see Significance; nullopt = unknown
  /// That the innovations depend on squares or cubes of the past; nullopt = not asked, since the
  /// noise is normal or nothing was near significance
  std::optional<double> innovation_p;
  std::optional<NoiseShape> noise;  ///< of the innovations; nullopt = there is no linear model
  /// Which coupling the p-values find at settings.alpha, given that nonlinear_p finds any.
  Coupling coupling = Coupling::none_found;
  std::vector<Peak> peaks;  ///< strongest first
};

/// Higher-order statistics of `signal` (usually the error sp - pv; any unit, any offset).
///
/// NaN or infinity marks a missing sample: every segment that touches one is dropped and the null
/// of the segments that are left applies. Returns nullopt when fewer than two segments are left or
/// the signal has no variance above rounding noise. Finite samples never give a NaN in the result.
/// `seed` drives the simulations of the second pass (significance.hpp): the same seed gives the
/// same result. May be called from many threads at once.
/// Throws std::invalid_argument for settings out of range.
/// `kernels` are those of this processor unless a test or a benchmark asks for others.
[[nodiscard]] std::optional<Result> analyse(std::span<const double> signal,
                                            const Settings& settings, std::uint64_t seed = 0,
                                            const Kernels& kernels = best_kernels());

/// The same with tests and peaks of `tested`, as long as `signal`: what is left of it once the
/// linear answer to something known, as to a setpoint that moves all the time, is taken out. The
/// published indices and moments stay those of `signal`. Where `tested` has fewer than two segments
/// or no variance, p-values, noise and peaks are not filled.
[[nodiscard]] std::optional<Result> analyse(std::span<const double> signal,
                                            std::span<const double> tested,
                                            const Settings& settings, std::uint64_t seed = 0,
                                            const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
