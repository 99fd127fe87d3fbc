#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/simulate/coloured_noise.hpp"

namespace loopscope::core::hos::tests {

/// Length of the paper's records.
inline constexpr std::size_t kRecord = 4096;

/// Gaussian white noise, mean 0, variance 1.
[[nodiscard]] std::vector<double> white_noise(std::uint64_t seed, std::size_t length = kRecord);

/// Exponential noise about its mean: mean 0, variance 1, third central moment 2, fourth 9.
[[nodiscard]] std::vector<double> exponential_noise(std::uint64_t seed,
                                                    std::size_t length = kRecord);

/// x(k) = pole x(k-1) + e(k) with white Gaussian e, from a settled state; pole 1 is a random walk.
[[nodiscard]] std::vector<double> first_order_noise(std::uint64_t seed, double pole,
                                                    std::size_t length = kRecord);

/// Three cosines at f1, f2, f1 + f2 whose phases are drawn anew in every block of 64 samples, the
/// third the sum of the others (`coupled`) or drawn as well, in noise of standard deviation 0.5.
[[nodiscard]] std::vector<double> triple(std::uint64_t seed, double f1, double f2, bool coupled);

/// Example 4.2 of the paper, eq. 17 and 18: sinusoids at 0.12 and 0.30, `square` times their
/// square (0.05 in the paper) and noise of variance 0.04.
[[nodiscard]] std::vector<double> two_sinusoids(std::uint64_t seed, double square);

/// cosine(2 pi k / period) in Gaussian noise of standard deviation 1.
[[nodiscard]] std::vector<double> sinusoid_in_noise(std::uint64_t seed, double period);

/// A wave of variance 1 at 10 dB over white Gaussian noise: `shape` of the phase in turns, which
/// starts at random and wanders by 0.1 radians (standard deviation) a cycle.
[[nodiscard]] std::vector<double> jittered_wave(std::uint64_t seed, double period,
                                                std::size_t length, double (*shape)(double turn));

/// Waves of variance 1, by the phase in turns, 0 to 1.
[[nodiscard]] double sine(double turn);
[[nodiscard]] double square(double turn);
[[nodiscard]] double triangle(double turn);
[[nodiscard]] double sawtooth(double turn);

/// Innovations of that law through a real pole.
[[nodiscard]] std::vector<double> coloured(simulate::Innovation law, double pole,
                                           std::uint64_t seed, std::size_t length = kRecord);

/// Resonance of period 20, poles' radius 0.95, driven by Gaussian noise: standard deviation
/// about 3.
[[nodiscard]] std::vector<double> resonance(std::uint64_t seed, std::size_t length = kRecord);

/// y(k) = gain x(k) + offset.
[[nodiscard]] std::vector<double> affine(std::span<const double> x, double gain, double offset);

}  // namespace loopscope::core::hos::tests
