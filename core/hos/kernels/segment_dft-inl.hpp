// Spectra of kWidth segments at once, one per lane; how is said at SegmentDft.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_SEGMENT_DFT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_SEGMENT_DFT_INL
#undef LOOPSCOPE_HOS_SEGMENT_DFT_INL
#else
#define LOOPSCOPE_HOS_SEGMENT_DFT_INL
#endif

#include <cstddef>
#include <hwy/highway.h>
#include <vector>

#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/segment_dft.hpp"
#include "core/hos/kernels/triple_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

struct Complex {
  Vector re;
  Vector im;
};

HWY_INLINE Complex operator+(Complex a, Complex b) {
  return {a.re + b.re, a.im + b.im};
}
HWY_INLINE Complex operator-(Complex a, Complex b) {
  return {a.re - b.re, a.im - b.im};
}
/// a - i b and a + i b, without an instruction for the turn.
HWY_INLINE Complex add_turned_back(Complex a, Complex b) {
  return {a.re + b.im, a.im - b.re};
}
HWY_INLINE Complex subtract_turned_back(Complex a, Complex b) {
  return {a.re - b.im, a.im + b.re};
}
/// a (cosine - i sine).
HWY_INLINE Complex turned(Complex a, const SegmentDft::Turn& turn) {
  const Vector cosine = broadcast(turn.cosine);
  const Vector sine = broadcast(turn.sine);
  return {multiply_add(a.im, sine, a.re * cosine), subtract_product(a.re, sine, a.im * cosine)};
}
/// (re - i im) (cosine - i sine).
HWY_INLINE Complex conjugate_turned(Vector re, Vector im, const SegmentDft::Turn& turn) {
  const Vector cosine = broadcast(turn.cosine);
  const Vector sine = broadcast(turn.sine);
  return {subtract_product(im, sine, re * cosine), hn::NegMulSub(re, sine, im * cosine)};
}
HWY_INLINE Complex load_complex(const double* z, std::size_t i) {
  return {load(z + 2 * i * kWidth), load(z + (2 * i + 1) * kWidth)};
}
HWY_INLINE void store_complex(double* z, std::size_t i, Complex value) {
  store(z + 2 * i * kWidth, value.re);
  store(z + (2 * i + 1) * kWidth, value.im);
}

/// DFTs of 2, 4 and 8 values in place, the outputs in their natural order.
HWY_INLINE void dft(Complex (&z)[1]) {
  static_cast<void>(z);
}
HWY_INLINE void dft(Complex (&z)[2]) {
  const Complex sum = z[0] + z[1];
  z[1] = z[0] - z[1];
  z[0] = sum;
}
HWY_INLINE void dft(Complex (&z)[4]) {
  const Complex even = z[0] + z[2];
  const Complex odd = z[1] + z[3];
  const Complex even_less = z[0] - z[2];
  const Complex odd_less = z[1] - z[3];
  z[0] = even + odd;
  z[1] = add_turned_back(even_less, odd_less);
  z[2] = even - odd;
  z[3] = subtract_turned_back(even_less, odd_less);
}
HWY_INLINE void dft(Complex (&z)[8]) {
  constexpr SegmentDft::Turn kEighth{0.70710678118654752440, 0.70710678118654752440};
  Complex even[4] = {z[0], z[2], z[4], z[6]};
  Complex odd[4] = {z[1], z[3], z[5], z[7]};
  dft(even);
  dft(odd);
  odd[1] = turned(odd[1], kEighth);
  odd[3] = turned(odd[3], kEighth);
  z[0] = even[0] + odd[0];
  z[1] = even[1] + odd[1];
  z[2] = add_turned_back(even[2], odd[2]);
  z[3] = add_turned_back(even[3], odd[3]);
  z[4] = even[0] - odd[0];
  z[5] = even[1] - odd[1];
  z[6] = subtract_turned_back(even[2], odd[2]);
  z[7] = subtract_turned_back(even[3], odd[3]);
}

/// Samples of kWidth segments into lanes, each about its own first sample, so that a constant
/// leaves exact zeros; returns the mean of what is left.
HWY_INLINE Vector load_segments(const SegmentBatch& batch, std::size_t lane, std::size_t length,
                                double* x) {
  const Vector factor = broadcast(batch.factor);
  Vector first = hn::Zero(Tag());
  Vector sums[4] = {};
  for (std::size_t n = 0; n < length; n += kWidth) {
    Vectors<kWidth> block;
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kWidth; ++i) {
      block.at[i] = load_anywhere(batch.segments[lane + i] + n);
    }
    transpose(block);
    if (n == 0) first = block.at[0] * factor;
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kWidth; ++i) {
      const Vector centred = hn::MulSub(block.at[i], factor, first);
      store(x + (n + i) * kWidth, centred);
      sums[i % 4] += centred;
    }
  }
  const Vector total = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return total / broadcast(static_cast<double>(length));
}

/// The turned outputs of a radix-4 step.
HWY_INLINE void store_step(Complex (&four)[4], const SegmentDft::Turn* turns, double* z,
                           std::size_t at, std::size_t quarter) {
  dft(four);
  store_complex(z, at, four[0]);
#pragma GCC unroll 4
  for (std::size_t q = 1; q < 4; ++q) {
    store_complex(z, at + q * quarter, turned(four[q], turns[q - 1]));
  }
}

/// The first two levels at once and the first step of the first, on samples less their mean,
/// tapered on the way: the upper half of the padded sequence is zero, so that the first level
/// leaves the sequence as it is.
HWY_INLINE void take_first_levels(double* x, Vector mean, const double* window,
                                  const SegmentDft& dft, std::size_t eighth, double* z0,
                                  double* z1) {
  const SegmentDft::Level& first = dft.levels()[0];
  const SegmentDft::Level& second = dft.levels()[1];
  for (std::size_t i = 0; i < eighth; ++i) {
    Vector y[8];
#pragma GCC unroll 8
    for (std::size_t q = 0; q < 8; ++q) {
      const std::size_t n = i + q * eighth;
      y[q] = (load(x + n * kWidth) - mean) * broadcast(window[n]);
    }
#pragma GCC unroll 4
    for (std::size_t q = 0; q < 4; ++q) store(x + (i + q * eighth) * kWidth, y[q] + y[q + 4]);
    store_complex(z1, i, turned({y[0] - y[4], y[6] - y[2]}, second.input_turns[i]));
    store_complex(z1, i + eighth,
                  turned({y[1] - y[5], y[7] - y[3]}, second.input_turns[i + eighth]));
    Complex four[4];
#pragma GCC unroll 4
    for (std::size_t q = 0; q < 4; ++q) {
      four[q] = conjugate_turned(y[q], y[q + 4], first.input_turns[i + q * eighth]);
    }
    store_step(four, first.steps[0].data() + 3 * i, z0, i, eighth);
  }
}

/// Input i of a level; leaves the sums in x.
HWY_INLINE Complex take_input(double* x, const SegmentDft::Level& level, std::size_t i) {
  const std::size_t half = 2 * level.length * kWidth;
  double* const near = x + i * kWidth;
  double* const far = near + level.length * kWidth;
  const Vector near_low = load(near);
  const Vector near_high = load(near + half);
  const Vector far_low = load(far);
  const Vector far_high = load(far + half);
  store(near, near_low + near_high);
  store(far, far_low + far_high);
  return turned({near_low - near_high, far_high - far_low}, level.input_turns[i]);
}

HWY_INLINE void radix_4_step(double* z, std::size_t length, std::size_t block,
                             const SegmentDft::Turn* turns) {
  const std::size_t quarter = block / 4;
  for (std::size_t start = 0; start < length; start += block) {
    for (std::size_t i = 0; i < quarter; ++i) {
      Complex four[4];
#pragma GCC unroll 4
      for (std::size_t q = 0; q < 4; ++q) four[q] = load_complex(z, start + i + q * quarter);
      store_step(four, turns + 3 * i, z, start + i, quarter);
    }
  }
}

HWY_INLINE void store_bin(const SegmentBatch& batch, std::size_t lane, SegmentDft::Place place,
                          Complex value) {
  double* const row = batch.rows + place.bin * SpectrumRows::kRows * batch.pitch + lane;
  store(row, value.re);
  store(row + batch.pitch, value.im * broadcast(place.sign));
  store(row + 2 * batch.pitch, multiply_add(value.im, value.im, value.re * value.re));
}

template <std::size_t radix>
HWY_INLINE void store_dft(Complex (&values)[radix], const SegmentDft::Level& level,
                          std::size_t start, const SegmentBatch& batch, std::size_t lane) {
  dft(values);
#pragma GCC unroll 8
  for (std::size_t t = 0; t < radix; ++t) {
    store_bin(batch, lane, level.places[start + t], values[t]);
  }
}

/// The last step of a level.
template <std::size_t radix>
void finish_steps(const double* z, const SegmentDft::Level& level, const SegmentBatch& batch,
                  std::size_t lane) {
  for (std::size_t start = 0; start < level.length; start += radix) {
    Complex values[radix];
#pragma GCC unroll 8
    for (std::size_t t = 0; t < radix; ++t) values[t] = load_complex(z, start + t);
    store_dft(values, level, start, batch, lane);
  }
}

/// A level of one step only, out of x.
template <std::size_t radix>
void finish_at_once(double* x, const SegmentDft::Level& level, const SegmentBatch& batch,
                    std::size_t lane) {
  Complex values[radix];
#pragma GCC unroll 8
  for (std::size_t t = 0; t < radix; ++t) values[t] = take_input(x, level, t);
  store_dft(values, level, 0, batch, lane);
}

/// Steps of a level from step number `from` on, on what lies in z.
HWY_INLINE void finish_level(double* z, const SegmentDft::Level& level, std::size_t from,
                             const SegmentBatch& batch, std::size_t lane) {
  std::size_t block = level.length >> (2 * from);
  for (std::size_t i = from; i < level.steps.size(); ++i, block /= 4) {
    radix_4_step(z, level.length, block, level.steps[i].data());
  }
  switch (level.last_radix) {
    case 8:
      return finish_steps<8>(z, level, batch, lane);
    case 4:
      return finish_steps<4>(z, level, batch, lane);
    default:
      return;
  }
}

void take_level(double* x, double* z, const SegmentDft::Level& level, const SegmentBatch& batch,
                std::size_t lane) {
  switch (level.length) {
    case 8:
      return finish_at_once<8>(x, level, batch, lane);
    case 4:
      return finish_at_once<4>(x, level, batch, lane);
    case 2:
      return finish_at_once<2>(x, level, batch, lane);
    case 1:
      return finish_at_once<1>(x, level, batch, lane);
    default:
      for (std::size_t i = 0; i < level.length; ++i) store_complex(z, i, take_input(x, level, i));
      return finish_level(z, level, 0, batch, lane);
  }
}

/// Of the paper's 64 samples: distances that the compiler knows take no registers.
constexpr std::size_t kUsualEighth = 8;

void transform_segments(const SegmentDft& dft, const SegmentBatch& batch) {
  double* const x = batch.scratch;
  double* const z0 = x + dft.segment_length() * kWidth;
  double* const z1 = z0 + dft.segment_length() * kWidth;
  for (std::size_t lane = 0; lane < kLanes; lane += kWidth) {
    const Vector mean = load_segments(batch, lane, dft.segment_length(), x);
    const std::size_t eighth = dft.segment_length() / 8;
    if (eighth == kUsualEighth) {
      take_first_levels(x, mean, batch.window, dft, kUsualEighth, z0, z1);
    } else {
      take_first_levels(x, mean, batch.window, dft, eighth, z0, z1);
    }
    finish_level(z0, dft.levels()[0], 1, batch, lane);
    finish_level(z1, dft.levels()[1], 0, batch, lane);
    for (std::size_t i = 2; i < dft.levels().size(); ++i) {
      take_level(x, z1, dft.levels()[i], batch, lane);
    }
    const Vector even = load(x);
    const Vector odd = load(x + kWidth);
    store_bin(batch, lane, {0, 1.0}, {even + odd, hn::Zero(Tag())});
    store_bin(batch, lane, {dft.dft_length() / 2, 1.0}, {even - odd, hn::Zero(Tag())});
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_SEGMENT_DFT_INL
