#include "core/simulate/limit_cycle.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/simulate/random.hpp"

namespace loopscope::core::simulate {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Two levels with mean 0 and variance 1, the upper one for `duty` of the cycle.
double two_levels(double place, double duty) {
  return place < duty ? std::sqrt((1.0 - duty) / duty) : -std::sqrt(duty / (1.0 - duty));
}

/// The wave at a place in the cycle, 0 to below 1.
double wave(WaveShape shape, double place) {
  constexpr double kAsymmetricDuty = 0.3;
  switch (shape) {
    case WaveShape::sine:
      return std::numbers::sqrt2 * std::sin(kTurn * place);
    case WaveShape::square:
      return two_levels(place, 0.5);
    case WaveShape::triangle:
      return std::numbers::sqrt3 * (4.0 * std::abs(place - 0.5) - 1.0);
    case WaveShape::sawtooth:
      return std::numbers::sqrt3 * (2.0 * place - 1.0);
    case WaveShape::asymmetric_square:
      return two_levels(place, kAsymmetricDuty);
  }
  throw std::invalid_argument("limit cycle: unknown wave shape");
}

}  // namespace

std::string_view name(WaveShape shape) {
  switch (shape) {
    case WaveShape::sine:
      return "sine";
    case WaveShape::square:
      return "square";
    case WaveShape::triangle:
      return "triangle";
    case WaveShape::sawtooth:
      return "sawtooth";
    case WaveShape::asymmetric_square:
      return "asymmetric_square";
  }
  throw std::invalid_argument("limit cycle: unknown wave shape");
}

std::vector<double> limit_cycle(const LimitCycle& cycle, std::size_t samples, std::uint64_t seed) {
  GaussianSource normal(seed);
  const double noise_std = std::pow(10.0, -cycle.snr_db / 20.0);
  const double jitter_cycles = cycle.jitter_rad / kTurn / std::sqrt(cycle.period_samples);
  // Streams of their own. Normal noise takes turns with the jitter.
  double cycles = UniformSource(~seed).next();
  std::vector<double> other;
  if (cycle.noise != Innovation::gaussian) other = innovations(cycle.noise, samples, seed + 1);
  std::vector<double> signal(samples);
  for (std::size_t t = 0; t < samples; ++t) {
    const double noise = other.empty() ? normal.next() : other[t];
    signal[t] = wave(cycle.shape, cycles - std::floor(cycles)) + noise_std * noise;
    cycles += 1.0 / cycle.period_samples + jitter_cycles * normal.next();
  }
  return signal;
}

}  // namespace loopscope::core::simulate
