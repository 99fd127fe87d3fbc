#include "core/hos/kernels/triple_tile.hpp"

#if defined(__x86_64__)

#include <algorithm>
#include <cmath>
#include <immintrin.h>
#include <limits>
#include <numbers>
#include <utility>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/principal_domain.hpp"

namespace loopscope::core::hos {
namespace {

#define LOOPSCOPE_TARGET __attribute__((target("avx512f")))

constexpr std::size_t kWidth = 8;
using Vector = __m512d;

/// Eighteen running sums, twelve of their operands: what 32 registers hold.
constexpr std::size_t kTileWide = 2;
constexpr std::size_t kPowerTileWide = 4;

LOOPSCOPE_TARGET inline Vector load(const double* values) {
  return _mm512_load_pd(values);
}
LOOPSCOPE_TARGET inline Vector load_anywhere(const double* values) {
  return _mm512_loadu_pd(values);
}
LOOPSCOPE_TARGET inline void store(double* values, Vector v) {
  _mm512_store_pd(values, v);
}
LOOPSCOPE_TARGET inline void store_anywhere(double* values, Vector v) {
  _mm512_storeu_pd(values, v);
}
LOOPSCOPE_TARGET inline Vector broadcast(double value) {
  return _mm512_set1_pd(value);
}
LOOPSCOPE_TARGET inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return _mm512_fmadd_pd(a, b, c);
}
LOOPSCOPE_TARGET inline Vector subtract_product(Vector a, Vector b, Vector c) {
  return _mm512_fnmadd_pd(a, b, c);
}

#include "core/hos/kernels/lanes.inc"
#include "core/hos/kernels/record_sums.inc"
#include "core/hos/kernels/row_scans.inc"
#include "core/hos/kernels/segment_dft.inc"
#include "core/hos/kernels/triple_tile.inc"

}  // namespace

const Kernels kAvx512Kernels{"avx512",     scan_magnitude,     transform_segments,
                             sum_each_row, sum_all_triples,    sum_powers,
                             sum_trend,    taper_record,       sum_differences,
                             sum_pairs,    predict_each_other, subtract_predictions,
                             apply_taps,   weigh_rows};

}  // namespace loopscope::core::hos

#endif
