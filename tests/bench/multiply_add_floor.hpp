#pragma once

#include <benchmark/benchmark.h>
#include <cstddef>
#include <string_view>

namespace loopscope::core::hos::bench {

/// One way to multiply and add as fast as a kind of processor can: `rounds` times kChains
/// independent multiply-adds of vectors of `lanes` doubles.
struct PeakLoop {
  static constexpr std::size_t kChains = 12;  ///< latency times throughput, and some
  std::size_t lanes;
  void (*run)(std::size_t rounds);
};

/// Of the path of this name: "avx512", "avx2" or "portable".
[[nodiscard]] PeakLoop peak_loop(std::string_view path);

/// Multiply-adds, one segment each, that the squared bicoherence of a window takes by its
/// definition, 127 segments, DFT of 128, 1024 bifrequencies. What is counted is instructions that
/// multiply, add or both; loads, stores and shuffles are free.
///
///   triple products: 9 per bifrequency and segment: 4 for X(k1) X(k2), 4 for that times
///     X*(k1 + k2) and the sums, 1 for |X(k1)|^2 |X(k2)|^2 and its sum
///   per segment 1464 to transform it:
///     256  scale less first sample 64, their sum 64, less mean 64, taper 64
///     376  turns of the inputs of the complex DFTs of 32, 16, 8, 4, 2 and 1: 4 for each of 63
///          values; sums and differences of the halves before: 4 for each of 31
///     700  those DFTs in radix 4 and 8: 448 + 176 + 56 + 16 + 4
///       2  zero frequency and half the sampling rate
///     130  powers
///
/// The estimate itself needs 8 where the definition has 9 (triple_tile-inl.hpp), so that it could
/// in principle go below this floor.
inline constexpr double kSegments = 127.0;
inline constexpr double kMultiplyAdds = kSegments * (9.0 * 1024.0 + 1464.0);

/// Time of kMultiplyAdds at the peak rate of the loop.
void multiply_add_floor(benchmark::State& state, const PeakLoop& loop);

}  // namespace loopscope::core::hos::bench
