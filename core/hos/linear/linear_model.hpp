#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// How many coefficients a linear model gets: the order with the least n ln(share of variance left)
/// + penalty times order.
struct OrderChoice {
  std::size_t largest = 24;  ///< enough for two resonances and the noise around them
  double penalty = 2.0;      ///< Akaike's, for innovations of one loudness
};

/// The linear process that explains a record best: x(t) = a_1 x(t-1) + ... + a_p x(t-p) + e(t), x
/// about its mean.
///
/// Burg's method (forward and backward prediction errors, always stable), order by AIC
/// unless said otherwise. It runs over the pieces between missing samples, so that a gap adds
/// nothing.
class LinearModel {
 public:
  /// NaN and infinity are missing. nullopt when the record has no variance, or fewer than
  /// kFewestResiduals samples that follow their predecessors without a gap.
  [[nodiscard]] static std::optional<LinearModel> fit(std::span<const double> signal,
                                                      const Kernels& kernels = best_kernels(),
                                                      const OrderChoice& order = {});
  static constexpr std::size_t kFewestResiduals = 100;

  /// a_1 .. a_p; empty = white.
  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }
  /// In the record's unit.
  [[nodiscard]] double mean() const { return mean_; }

  /// What the model does not predict of `signal`, as long as it; NaN where the sample or one that
  /// its prediction needs is missing.
  [[nodiscard]] std::vector<double> errors(std::span<const double> signal,
                                           const Kernels& kernels = best_kernels()) const;

  /// The model of the same order with the least sum of squared errors over squared `scale`, so that
  /// loud stretches weigh no more than calm ones; this one where that would not be stable. `scale`
  /// (> 0) and `errors` as long as `signal`, `errors` those of any model of this order.
  [[nodiscard]] LinearModel reweighted(std::span<const double> signal,
                                       std::span<const double> errors,
                                       std::span<const double> scale,
                                       const Kernels& kernels = best_kernels()) const;

  /// Turns `record` from innovations into the process that they drive, about mean 0; its first
  /// samples, as many as there are coefficients, are taken as they are.
  void drive(std::span<double> record) const;

 private:
  LinearModel(std::vector<double> coefficients, double mean)
      : coefficients_(std::move(coefficients)), mean_(mean) {}

  std::vector<double> coefficients_;
  double mean_;
};

}  // namespace loopscope::core::hos
