#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/kernels/triple_tile.hpp"

namespace loopscope::core::hos {
namespace {

#define LOOPSCOPE_TARGET

// Two lanes fill the vector registers of every 64-bit processor.
constexpr std::size_t kWidth = 2;
using Vector [[gnu::vector_size(kWidth * sizeof(double)), gnu::may_alias]] = double;
using LooseVector [[gnu::vector_size(kWidth * sizeof(double)), gnu::aligned(8), gnu::may_alias]] =
    double;

/// Nine running sums: what 16 registers hold besides their operands.
constexpr std::size_t kTileWide = 1;
constexpr std::size_t kPowerTileWide = 3;

inline Vector load(const double* values) {
  return *reinterpret_cast<const Vector*>(values);
}
inline Vector load_anywhere(const double* values) {
  return *reinterpret_cast<const LooseVector*>(values);
}
inline void store(double* values, Vector v) {
  *reinterpret_cast<Vector*>(values) = v;
}
inline void store_anywhere(double* values, Vector v) {
  *reinterpret_cast<LooseVector*>(values) = v;
}
inline Vector broadcast(double value) {
  return Vector{value, value};
}
inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return a * b + c;
}
inline Vector subtract_product(Vector a, Vector b, Vector c) {
  return c - a * b;
}

#include "core/hos/kernels/lanes.inc"
#include "core/hos/kernels/record_sums.inc"
#include "core/hos/kernels/row_scans.inc"
#include "core/hos/kernels/segment_dft.inc"
#include "core/hos/kernels/triple_tile.inc"

}  // namespace

const Kernels kPortableKernels{"portable",   scan_magnitude,     transform_segments,
                               sum_each_row, sum_all_triples,    sum_powers,
                               sum_trend,    taper_record,       sum_differences,
                               sum_pairs,    predict_each_other, subtract_predictions,
                               apply_taps,   weigh_rows};

}  // namespace loopscope::core::hos
