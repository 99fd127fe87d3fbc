#include "core/hos/triple_tile.hpp"

namespace loopscope::core::hos {
namespace {

#define LOOPSCOPE_TARGET

// Two doubles: a register of every 64-bit processor.
constexpr std::size_t kWidth = 2;
using Vector [[gnu::vector_size(kWidth * sizeof(double)), gnu::may_alias]] = double;

inline Vector load(const double* values) {
  return *reinterpret_cast<const Vector*>(values);
}
inline Vector multiply_add(Vector a, Vector b, Vector c) {
  return a * b + c;
}
inline Vector subtract_product(Vector a, Vector b, Vector c) {
  return c - a * b;
}
inline double total(Vector v) {
  return v[0] + v[1];
}

#include "core/hos/triple_tile.inc"

}  // namespace

const TileKernel kPortableTile{"portable", sum_tile};

}  // namespace loopscope::core::hos
