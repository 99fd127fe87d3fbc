// What the kernels do across the lanes of vectors.
//
// Compiled once for each kind of processor that kernels.cpp is made for, as Highway's
// foreach_target.h asks: hence the guard that is turned round instead of set.
#if defined(LOOPSCOPE_HOS_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_LANES_INL
#undef LOOPSCOPE_HOS_LANES_INL
#else
#define LOOPSCOPE_HOS_LANES_INL
#endif

#include <cstddef>
#include <hwy/highway.h>

#include "core/hos/kernels/aligned.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The widest vector of doubles, kWidth of them.
using Tag = hn::CappedTag<double, kLanes>;
using Vector = hn::Vec<Tag>;
inline constexpr std::size_t kWidth = HWY_LANES(double) < kLanes ? HWY_LANES(double) : kLanes;

HWY_INLINE Vector load(const double* values) {
  return hn::Load(Tag(), values);
}
HWY_INLINE Vector load_anywhere(const double* values) {
  return hn::LoadU(Tag(), values);
}
HWY_INLINE void store(double* values, Vector v) {
  hn::Store(v, Tag(), values);
}
HWY_INLINE void store_anywhere(double* values, Vector v) {
  hn::StoreU(v, Tag(), values);
}
HWY_INLINE Vector broadcast(double value) {
  return hn::Set(Tag(), value);
}
/// a b + c.
HWY_INLINE Vector multiply_add(Vector a, Vector b, Vector c) {
  return hn::MulAdd(a, b, c);
}
/// c - a b.
HWY_INLINE Vector subtract_product(Vector a, Vector b, Vector c) {
  return hn::NegMulAdd(a, b, c);
}

/// An array that fits into registers; std::array drops the alignment of vectors.
template <std::size_t count>
struct Vectors {
  Vector at[count];
};

#if HWY_TARGET == HWY_SCALAR

/// One lane has no neighbours: never called.
template <std::size_t step>
Vector low_lanes(Vector a, Vector b);
template <std::size_t step>
Vector high_lanes(Vector a, Vector b);

#else

/// Lanes without the bit `step` from both: a's stay where they are, b's move up by `step`.
template <std::size_t step>
HWY_INLINE Vector low_lanes(Vector a, Vector b) {
  if constexpr (step == 1) {
    return hn::InterleaveLower(Tag(), a, b);
  } else if constexpr (2 * step == kWidth) {
    return hn::ConcatLowerLower(Tag(), b, a);
  } else {
    return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
  }
}

/// Lanes with the bit `step` from both: b's stay where they are, a's move down.
template <std::size_t step>
HWY_INLINE Vector high_lanes(Vector a, Vector b) {
  if constexpr (step == 1) {
    return hn::InterleaveUpper(Tag(), a, b);
  } else if constexpr (2 * step == kWidth) {
    return hn::ConcatUpperUpper(Tag(), b, a);
  } else {
    return hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
  }
}

#endif

/// sums[i] = sum over the lanes of v.at[i]; `sums` has room for whole vectors.
template <std::size_t step = 1, std::size_t count>
HWY_INLINE void sum_lanes(const Vectors<count>& v, double* sums) {
  if constexpr (step == kWidth) {
#pragma GCC unroll 32
    for (std::size_t i = 0; i < count; ++i) store(sums + i * kWidth, v.at[i]);
  } else {
    Vectors<(count + 1) / 2> folded;
#pragma GCC unroll 32
    for (std::size_t i = 0; i < (count + 1) / 2; ++i) {
      const Vector a = v.at[2 * i];
      const Vector b = 2 * i + 1 < count ? v.at[2 * i + 1] : a;
      folded.at[i] = low_lanes<step>(a, b) + high_lanes<step>(a, b);
    }
    sum_lanes<2 * step>(folded, sums);
  }
}

/// Rows become columns.
template <std::size_t step = 1>
HWY_INLINE void transpose(Vectors<kWidth>& v) {
  if constexpr (step < kWidth) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kWidth; ++i) {
      if ((i & step) != 0) continue;
      const Vector a = v.at[i];
      const Vector b = v.at[i + step];
      v.at[i] = low_lanes<step>(a, b);
      v.at[i + step] = high_lanes<step>(a, b);
    }
    transpose<2 * step>(v);
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_LANES_INL
