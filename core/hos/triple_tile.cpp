#include "core/hos/triple_tile.hpp"

namespace loopscope::core::hos {
namespace {

const TileKernel& choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) {
    return kAvx512Tile;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return kAvx2Tile;
  }
#endif
  return kPortableTile;
}

}  // namespace

const TileKernel& best_tile_kernel() {
  static const TileKernel& kernel = choose();
  return kernel;
}

}  // namespace loopscope::core::hos
