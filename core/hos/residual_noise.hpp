#pragma once

#include <random>
#include <vector>

namespace loopscope::core::hos {

/// The distribution of the noise that drives a loop, read from the residuals of its linear model.
///
/// Residuals hold noise and, in a loop that sticks or is upset, events: ten to a hundred values in
/// a window that no noise explains. Only the core, from the 3rd to the 97th percentile, is taken as
/// it is; outside it the noise goes on as an exponential tail at the rate that the stretch from the
/// 20th (80th) percentile to the 3rd (97th) shows. Exponential and Laplacian noise keep their own
/// tails that way, Gaussian and lighter noise get slightly heavier ones.
class ResidualNoise {
 public:
  /// At least 100 residuals.
  explicit ResidualNoise(std::vector<double> residuals);

  /// How the core compares with that of normal noise, for which the null of the first pass holds
  /// whatever events there are besides.
  enum class Core {
    gaussian,   ///< as symmetric and as wide
    undecided,  ///< symmetric, wider than chance allows, narrower than Laplacian noise
    other,      ///< skewed, light like uniform or heavy like Laplacian noise
  };
  [[nodiscard]] Core core() const { return core_; }

  /// One independent value; mean 0.
  [[nodiscard]] double draw(std::mt19937_64& random) const;

 private:
  std::vector<double> values_;  // equally likely
  Core core_ = Core::gaussian;
};

}  // namespace loopscope::core::hos
