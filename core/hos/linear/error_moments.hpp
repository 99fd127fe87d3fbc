#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace loopscope::core::hos {

/// Mean and lagged products of independent errors over one sub-window or several: what changes when
/// the linear process behind them does.
class ErrorMoments {
 public:
  /// Enough for a resonance that appears or goes; more lags cost power.
  static constexpr std::size_t kLags = 8;
  /// The mean and one for each lag.
  static constexpr std::size_t kCount = kLags + 1;

  ErrorMoments() = default;
  /// Of one sub-window, divided by its root mean square first: how loud it is does not count. NaN
  /// is missing.
  explicit ErrorMoments(std::span<const double> errors);
  ErrorMoments& operator+=(const ErrorMoments& other);

  struct Difference {
    /// Chi squared of kCount where nothing changed. The variances are those of the products
    /// themselves (White 1980), so that errors need not be Gaussian.
    double chi_squared = 0.0;
    double size = 0.0;  ///< sum of the squared differences; 0.16 is one correlation of 0.4
  };
  [[nodiscard]] Difference difference_from(const ErrorMoments& other) const;

 private:
  struct Moment {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    /// Of these values; what is not finite is missing.
    void set(Eigen::ArrayXd values);
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double variance_of_mean() const;
  };
  std::array<Moment, kCount> moments_;
};

}  // namespace loopscope::core::hos
