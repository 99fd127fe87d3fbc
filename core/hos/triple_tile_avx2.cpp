#include "core/hos/triple_tile.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace loopscope::core::hos {
namespace {

#define LOOPSCOPE_TARGET __attribute__((target("avx2,fma")))

constexpr std::size_t kWidth = 4;
using Vector = __m256d;

LOOPSCOPE_TARGET inline Vector load(const double* values) {
  return _mm256_load_pd(values);
}
LOOPSCOPE_TARGET inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return _mm256_fmadd_pd(a, b, c);
}
LOOPSCOPE_TARGET inline Vector subtract_product(Vector a, Vector b, Vector c) {
  return _mm256_fnmadd_pd(a, b, c);
}
LOOPSCOPE_TARGET inline double total(Vector v) {
  const __m128d pairs = _mm_add_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
  return pairs[0] + pairs[1];
}

#include "core/hos/triple_tile.inc"

}  // namespace

const TileKernel kAvx2Tile{"avx2", sum_tile};

}  // namespace loopscope::core::hos

#endif
