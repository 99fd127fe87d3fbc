#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/effects/random.hpp"

namespace loopscope::tests::effects {

/// Steps of the simulation in one sample: the friction of a valve and the lags act between samples.
inline constexpr int kSubsteps = 20;
inline constexpr double kStep = 1.0 / kSubsteps;  ///< samples

/// A wandering load, white noise through AR(1) or an integrator and, when it enters at the process
/// input, through the lags of the process: x+ = F x + (scale w, 0, 0), output c x, one substep
/// each.
struct LoadModel {
  Eigen::Matrix3d transition = Eigen::Matrix3d::Zero();
  Eigen::RowVector3d output = Eigen::RowVector3d::Zero();
  double scale = 0.0;

  [[nodiscard]] double value(const Eigen::Vector3d& state) const { return output * state; }
  /// `noise`: w of this substep, of variance 1.
  void step(Eigen::Vector3d& state, double noise) const;
  /// The wandering itself, before lags, forgets within `samples` (1/e) at the latest.
  void return_within(double samples);
};

/// `memory` per sample, 1 = integrated noise; one unit of `scale` is one of w's deviation a sample.
[[nodiscard]] LoadModel output_load_model(double memory);

/// The lags that a load at the process input passes; times in samples.
struct LoadPath {
  bool integrating = false;
  double gain = 1.0;
  double tau = 10.0;
  double second_tau = 0.0;
};
[[nodiscard]] LoadModel input_load_model(double memory, const LoadPath& path);

/// The steady Kalman filter of load plus white noise of variance `noise_variance`, when a value
/// comes every `hold` samples.
struct Predictor {
  Eigen::Matrix3d transition;
  Eigen::RowVector3d output;
  Eigen::Vector3d gain;
  double variance = 0.0;  ///< of the innovations

  /// What the filter did not foresee in each of `values`.
  [[nodiscard]] std::vector<double> innovations(const std::vector<double>& values) const;
};
[[nodiscard]] Predictor predictor(const LoadModel& load, double noise_variance, int hold);

}  // namespace loopscope::tests::effects
