#pragma once

#include <cstddef>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "core/hos/kernels.hpp"
#include "core/hos/residual_noise.hpp"

namespace loopscope::core::hos {

/// The linear process that explains a record best: x(t) = a_1 x(t-1) + ... + a_p x(t-p) + e(t), x
/// about its mean, e independent noise with the distribution of the record's own residuals.
///
/// Burg's method (forward and backward prediction errors, always stable), order by AIC. It runs
/// over the pieces between missing samples, so that a gap adds nothing.
class LinearModel {
 public:
  /// NaN and infinity are missing. nullopt when the record has no variance, or fewer than
  /// kFewestResiduals samples that follow their predecessors without a gap.
  [[nodiscard]] static std::optional<LinearModel> fit(std::span<const double> signal,
                                                      const Kernels& kernels = best_kernels());
  static constexpr std::size_t kFewestResiduals = 100;

  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }
  [[nodiscard]] const ResidualNoise& noise() const { return noise_; }

  /// A record of this process, driven by independent noise; missing where `like` is missing, and of
  /// its length. The process has mean 0.
  [[nodiscard]] std::vector<double> draw(std::span<const double> like,
                                         std::mt19937_64& random) const;
  /// The same into `record`, which keeps its memory.
  void draw(std::span<const double> like, std::mt19937_64& random,
            std::vector<double>& record) const;

 private:
  LinearModel(std::vector<double> coefficients, ResidualNoise noise)
      : coefficients_(std::move(coefficients)), noise_(std::move(noise)) {}

  std::vector<double> coefficients_;
  ResidualNoise noise_;
};

}  // namespace loopscope::core::hos
