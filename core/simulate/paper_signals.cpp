#include "core/simulate/paper_signals.hpp"

#include <cmath>
#include <numbers>

#include "core/simulate/band_pass.hpp"
#include "core/simulate/random.hpp"

namespace loopscope::core::simulate {

namespace {

/// Samples dropped at the start of the filter: its poles lie at 0.978, so that nothing above
/// rounding is left of the rest it starts from.
constexpr std::size_t kFilterSettling = 2000;

std::vector<double> narrow_band(std::size_t samples, std::uint64_t seed, double square) {
  GaussianSource noise(seed);
  std::vector<double> drive(kFilterSettling + samples);
  for (double& sample : drive) {
    sample = 3.0 * noise.next();
  }
  const std::vector<double> filtered = BandPass(0.095, 0.105).filter(drive);
  std::vector<double> signal(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double x = filtered[kFilterSettling + k];
    signal[k] = x + square * x * x + std::sqrt(0.001) * noise.next();
  }
  return signal;
}

std::vector<double> two_sinusoids(std::size_t samples, std::uint64_t seed, double square) {
  constexpr double kCycle_rad = 2.0 * std::numbers::pi;
  GaussianSource noise(seed);
  std::vector<double> signal(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const auto time = static_cast<double>(k);
    const double x = std::sin(kCycle_rad * 0.12 * time + std::numbers::pi / 3.0) +
                     std::sin(kCycle_rad * 0.30 * time + std::numbers::pi / 8.0);
    signal[k] = x + square * x * x + 0.2 * noise.next();
  }
  return signal;
}

}  // namespace

std::vector<double> narrow_band_linear(std::size_t samples, std::uint64_t seed) {
  return narrow_band(samples, seed, 0.0);
}

std::vector<double> narrow_band_squared(std::size_t samples, std::uint64_t seed) {
  return narrow_band(samples, seed, 0.1);
}

std::vector<double> two_sinusoids_linear(std::size_t samples, std::uint64_t seed) {
  return two_sinusoids(samples, seed, 0.0);
}

std::vector<double> two_sinusoids_squared(std::size_t samples, std::uint64_t seed) {
  return two_sinusoids(samples, seed, 0.05);
}

}  // namespace loopscope::core::simulate
