#include "tests/core/hos/signals.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/numbers.hpp"

namespace loopscope::core::hos::tests {
namespace {

using loopscope::tests::kTurn;

double cosine(double frequency, std::size_t k, double phase) {
  return std::cos(kTurn * frequency * static_cast<double>(k) + phase);
}

}  // namespace

std::vector<double> white_noise(std::uint64_t seed, std::size_t length) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> x(length);
  for (double& sample : x) {
    sample = normal(generator);
  }
  return x;
}

std::vector<double> exponential_noise(std::uint64_t seed, std::size_t length) {
  std::mt19937_64 generator(seed);
  std::exponential_distribution<double> exponential;
  std::vector<double> x(length);
  for (double& sample : x) {
    sample = exponential(generator) - 1.0;
  }
  return x;
}

std::vector<double> first_order_noise(std::uint64_t seed, double pole, std::size_t length) {
  std::vector<double> x = white_noise(seed, length);
  if (pole < 1.0) {
    x[0] /= std::sqrt(1.0 - pole * pole);
  }
  for (std::size_t k = 1; k < length; ++k) {
    x[k] += pole * x[k - 1];
  }
  return x;
}

std::vector<double> triple(std::uint64_t seed, double f1, double f2, bool coupled) {
  constexpr std::size_t kBlock = 64;
  std::vector<double> x = affine(white_noise(seed), 0.5, 0.0);
  std::mt19937_64 generator(seed + 1'000'000);
  std::uniform_real_distribution<double> phase(0.0, kTurn);
  double phase1 = 0.0;
  double phase2 = 0.0;
  double phase3 = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (k % kBlock == 0) {
      phase1 = phase(generator);
      phase2 = phase(generator);
      phase3 = coupled ? phase1 + phase2 : phase(generator);
    }
    x[k] += cosine(f1, k, phase1) + cosine(f2, k, phase2) + cosine(f1 + f2, k, phase3);
  }
  return x;
}

std::vector<double> two_sinusoids(std::uint64_t seed, double square) {
  std::vector<double> y = affine(white_noise(seed), 0.2, 0.0);
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double time = kTurn * static_cast<double>(k);
    const double x = std::sin(0.12 * time + std::numbers::pi / 3.0) +
                     std::sin(0.30 * time + std::numbers::pi / 8.0);
    y[k] += x + square * x * x;
  }
  return y;
}

std::vector<double> sinusoid_in_noise(std::uint64_t seed, double period) {
  std::vector<double> x = white_noise(seed);
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] += cosine(1.0 / period, k, 0.0);
  }
  return x;
}

std::vector<double> jittered_wave(std::uint64_t seed, double period, std::size_t length,
                                  double (*shape)(double turn)) {
  constexpr double kJitter = 0.1 / kTurn;  // turns per root cycle
  const double noise = std::sqrt(0.1);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  double turn = std::uniform_real_distribution<double>()(generator);
  std::vector<double> x(length);
  for (double& sample : x) {
    turn += 1.0 / period + kJitter / std::sqrt(period) * normal(generator);
    sample = shape(turn - std::floor(turn)) + noise * normal(generator);
  }
  return x;
}

double sine(double turn) {
  return std::numbers::sqrt2 * std::sin(kTurn * turn);
}

double square(double turn) {
  return turn < 0.5 ? 1.0 : -1.0;
}

double triangle(double turn) {
  return std::numbers::sqrt3 * (turn < 0.5 ? 4.0 * turn - 1.0 : 3.0 - 4.0 * turn);
}

double sawtooth(double turn) {
  return std::numbers::sqrt3 * (2.0 * turn - 1.0);
}

std::vector<double> coloured(simulate::Innovation law, double pole, std::uint64_t seed,
                             std::size_t length) {
  return simulate::coloured_noise(simulate::real_pole(pole), law, length, seed);
}

std::vector<double> resonance(std::uint64_t seed, std::size_t length) {
  return simulate::coloured_noise(simulate::resonance(20.0, 0.95), simulate::Innovation::gaussian,
                                  length, seed);
}

std::vector<double> affine(std::span<const double> x, double gain, double offset) {
  std::vector<double> y(x.begin(), x.end());
  for (double& sample : y) {
    sample = gain * sample + offset;
  }
  return y;
}

}  // namespace loopscope::core::hos::tests
