#include "tests/effects/load_model.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::effects {
namespace {

/// Row `state` of the transition: a lag (or vessel) of time constant tau that `source` drives.
void add_lag(Eigen::Matrix3d& transition, Eigen::Index state, Eigen::Index source, double gain,
             double tau) {
  const double keep = std::exp(-kStep / tau);
  transition(state, state) = keep;
  transition(state, source) = gain * (1.0 - keep);
}

/// Covariance that `steps` substeps of unit noise add.
Eigen::Matrix3d added_covariance(const LoadModel& load, int steps) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < steps; ++i) {
    sum = (load.transition * sum * load.transition.transpose()).eval();
    sum(0, 0) += load.scale * load.scale * kStep;
  }
  return sum;
}

Eigen::Matrix3d power(const Eigen::Matrix3d& matrix, int exponent) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (int i = 0; i < exponent; ++i) result = (result * matrix).eval();
  return result;
}

}  // namespace

void LoadModel::step(Eigen::Vector3d& state, double noise) const {
  state = (transition * state).eval();
  state(0) += scale * std::sqrt(kStep) * noise;
}

void LoadModel::return_within(double samples) {
  transition(0, 0) = std::min(transition(0, 0), std::exp(-kStep / samples));
}

LoadModel output_load_model(double memory) {
  LoadModel model;
  model.transition(0, 0) = std::pow(memory, kStep);
  model.output(0) = 1.0;
  model.scale = 1.0;
  return model;
}

LoadModel input_load_model(double memory, const LoadPath& path) {
  LoadModel model = output_load_model(memory);
  if (path.integrating) {
    model.transition(1, 1) = 1.0;
    model.transition(1, 0) = path.gain * kStep / path.tau;
  } else {
    add_lag(model.transition, 1, 0, path.gain, path.tau);
  }
  const bool second = path.second_tau > 0.0;
  if (second) add_lag(model.transition, 2, 1, 1.0, path.second_tau);
  model.output = Eigen::RowVector3d(0.0, second ? 0.0 : 1.0, second ? 1.0 : 0.0);
  return model;
}

Predictor predictor(const LoadModel& load, double noise_variance, int hold) {
  constexpr int kMostIterations = 100000;
  constexpr double kSettled = 1e-12;
  const Eigen::Matrix3d added = added_covariance(load, hold * kSubsteps);
  Predictor result{power(load.transition, hold * kSubsteps), load.output, {}, 0.0};
  Eigen::Matrix3d covariance = added;
  for (int i = 0; i < kMostIterations; ++i) {
    const Eigen::Vector3d cross = covariance * load.output.transpose();
    const double variance = load.output * cross + noise_variance;
    result.gain = cross / variance;
    covariance -= (result.gain * cross.transpose()).eval();
    covariance = (result.transition * covariance * result.transition.transpose()).eval() + added;
    const double change = std::abs(variance - result.variance);
    result.variance = variance;
    if (change < kSettled * variance) break;
  }
  return result;
}

std::vector<double> Predictor::innovations(const std::vector<double>& values) const {
  std::vector<double> unforeseen;
  Eigen::Vector3d state = Eigen::Vector3d::Zero();
  for (const double value : values) {
    const double error = value - output * state;
    unforeseen.push_back(error);
    state = (transition * (state + gain * error)).eval();
  }
  return unforeseen;
}

}  // namespace loopscope::tests::effects
