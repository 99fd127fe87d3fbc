#include "core/hos/triple_tile.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace loopscope::core::hos {
namespace {

#define LOOPSCOPE_TARGET __attribute__((target("avx512f")))

constexpr std::size_t kWidth = 8;
using Vector = __m512d;

LOOPSCOPE_TARGET inline Vector load(const double* values) {
  return _mm512_load_pd(values);
}
LOOPSCOPE_TARGET inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return _mm512_fmadd_pd(a, b, c);
}
LOOPSCOPE_TARGET inline Vector subtract_product(Vector a, Vector b, Vector c) {
  return _mm512_fnmadd_pd(a, b, c);
}
// Not _mm512_reduce_add_pd, which g++ 12 compiles with a warning from its own header.
LOOPSCOPE_TARGET inline double total(Vector v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

#include "core/hos/triple_tile.inc"

}  // namespace

const TileKernel kAvx512Tile{"avx512", sum_tile};

}  // namespace loopscope::core::hos

#endif
