#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace loopscope::core::hos {

/// Rows of a 2 x 2 tile of bifrequencies (k1 + i, k2 + j): each pointer is a frequency's real row,
/// followed by its imaginary and its power row (layout of Spectra).
struct TileRows {
  std::array<const double*, 2> k1;   ///< k1, k1 + 1
  std::array<const double*, 2> k2;   ///< k2, k2 + 1
  std::array<const double*, 3> sum;  ///< k1 + k2, k1 + k2 + 1, k1 + k2 + 2
  std::size_t row_length;            ///< doubles, a multiple of kLanes
};

/// Sums over segments at one bifrequency; see TripleSums.
struct TripleSum {
  double real = 0.0;
  double imaginary = 0.0;
  double power12 = 0.0;
};

/// Sums at (k1, k2), (k1 + 1, k2), (k1, k2 + 1), (k1 + 1, k2 + 1).
using TileSums = std::array<TripleSum, 4>;

/// One way to compute a tile, for one kind of processor. Two bifrequencies in each direction share
/// the rows of their sum frequency, and twelve running sums hide the latency of the multiply-adds.
struct TileKernel {
  std::string_view name;
  void (*sum)(const TileRows& rows, TileSums& sums);
};

/// Runs everywhere; multiplies and adds round separately.
extern const TileKernel kPortableTile;
#if defined(__x86_64__)
/// Need AVX2 with FMA, and AVX-512F. Fused multiply-adds round once, so that their last digits
/// differ from the portable ones.
extern const TileKernel kAvx2Tile;
extern const TileKernel kAvx512Tile;
#endif

/// The fastest of them on this processor, chosen once.
[[nodiscard]] const TileKernel& best_tile_kernel();

}  // namespace loopscope::core::hos
