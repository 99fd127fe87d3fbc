// Sums of triple products over the whole principal domain, tile by tile.
//
// A complex product takes three multiplications instead of four (Gauss), here for a b and again for
// (a b) c*; with fused multiply-adds that is six and a few additions per bifrequency and segment
// where the definition takes eight, and additions have units of their own on most processors:
//
//   t = b_r (a_r + a_i)                P_r = t - a_i (b_r + b_i)      P_i = t + a_r (b_i - b_r)
//   both = sum (P_r + P_i) c_r         Re = both - sum P_i (c_r - c_i)
//                                      Im = both - sum P_r (c_r + c_i)
//
// Three bifrequencies along k2 share their rows of k1, and those of one k1 + k2 their rows of it.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_TRIPLE_TILE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_TRIPLE_TILE_INL
#undef LOOPSCOPE_HOS_TRIPLE_TILE_INL
#else
#define LOOPSCOPE_HOS_TRIPLE_TILE_INL
#endif

#include <algorithm>
#include <cstddef>
#include <hwy/highway.h>

#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/kernels/triple_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

constexpr std::size_t kTileHigh = 3;

/// Bifrequencies along k1 in a tile of triple products, of powers: as many running sums and
/// operands as the registers hold, of which AVX-512 and NEON have 32 and the others 16.
constexpr bool kManyRegisters = HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON;
constexpr std::size_t kTileWide = kManyRegisters ? 2 : 1;
constexpr std::size_t kPowerTileWide = kManyRegisters ? 4 : 3;

/// Height of the tile at (k1, k2) that holds every bifrequency of the domain in `wide` columns.
inline std::size_t tile_height(const PrincipalDomain& domain, Bifrequency at, std::size_t wide,
                               std::size_t most) {
  std::size_t height = 0;
  for (std::size_t k1 = at.k1; k1 < at.k1 + wide; ++k1) {
    while (height < most && domain.contains({k1, at.k2 + height})) ++height;
  }
  return height;
}

struct PartialSum {
  Vector both{};
  Vector with_real{};       // P_r (c_r + c_i)
  Vector with_imaginary{};  // P_i (c_r - c_i)
};

template <std::size_t wide, std::size_t high>
void sum_triple_tile(const SpectrumRows& rows, Bifrequency at, double* sums) {
  const std::size_t pitch = rows.pitch;
  const std::size_t stride = rows.stride();
  const double* const first = rows.real(at.k1);
  const double* const second = rows.real(at.k2);
  const double* const third = rows.real(at.k1 + at.k2);
  PartialSum partial[high][wide];
  for (std::size_t s = 0; s < rows.row_length; s += kWidth) {
    Vector a_re[wide];
    Vector a_im[wide];
    Vector a_sum[wide];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < wide; ++i) {
      a_re[i] = load(first + i * stride + s);
      a_im[i] = load(first + i * stride + pitch + s);
      a_sum[i] = a_re[i] + a_im[i];
    }
#pragma GCC unroll 4
    for (std::size_t j = 0; j < high; ++j) {
      const Vector b_re = load(second + j * stride + s);
      const Vector b_im = load(second + j * stride + pitch + s);
      const Vector b_sum = b_re + b_im;
      const Vector b_difference = b_re - b_im;
#pragma GCC unroll 4
      for (std::size_t i = 0; i < wide; ++i) {
        const Vector common = b_re * a_sum[i];
        const Vector re = subtract_product(a_im[i], b_sum, common);
        const Vector im = subtract_product(a_re[i], b_difference, common);
        const Vector c_re = load(third + (i + j) * stride + s);
        const Vector c_im = load(third + (i + j) * stride + pitch + s);
        PartialSum& sum = partial[j][i];
        sum.both = multiply_add(re + im, c_re, sum.both);
        sum.with_real = multiply_add(re, c_re + c_im, sum.with_real);
        sum.with_imaginary = multiply_add(im, c_re - c_im, sum.with_imaginary);
      }
    }
  }
  Vectors<2 * wide * high> totals;
#pragma GCC unroll 16
  for (std::size_t i = 0; i < wide * high; ++i) {
    const PartialSum& sum = partial[i / wide][i % wide];
    totals.at[2 * i] = sum.both - sum.with_imaginary;
    totals.at[2 * i + 1] = sum.both - sum.with_real;
  }
  sum_lanes(totals, sums);
}

template <std::size_t wide, std::size_t high>
void sum_power_tile(const SpectrumRows& rows, Bifrequency at, double* sums) {
  const std::size_t stride = rows.stride();
  const double* const first = rows.real(at.k1) + 2 * rows.pitch;
  const double* const second = rows.real(at.k2) + 2 * rows.pitch;
  Vectors<wide * high> totals{};
  for (std::size_t s = 0; s < rows.row_length; s += kWidth) {
    Vector a[wide];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < wide; ++i) a[i] = load(first + i * stride + s);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < high; ++j) {
      const Vector b = load(second + j * stride + s);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < wide; ++i) {
        totals.at[j * wide + i] = multiply_add(a[i], b, totals.at[j * wide + i]);
      }
    }
  }
  sum_lanes(totals, sums);
}

using TileKernel = void (*)(const SpectrumRows& rows, Bifrequency at, double* sums);

/// Calls store(bifrequency, its place in `sums`) for the tiles of one size that cover the domain;
/// tiles[h - 1] is the tile of height h. What sticks out of the domain is dropped.
template <std::size_t wide, std::size_t high, class Store>
void sweep(const SpectrumRows& rows, const TileKernel (&tiles)[high], const Store& store) {
  const PrincipalDomain domain(rows.dft_length);
  alignas(kAlignment) double sums[2 * wide * high + kWidth];
  for (std::size_t k2 = 1; k2 <= domain.rows(); k2 += high) {
    for (std::size_t k1 = k2; k1 < k2 + domain.row_size(k2); k1 += wide) {
      const std::size_t height = tile_height(domain, {k1, k2}, wide, high);
      tiles[height - 1](rows, {k1, k2}, sums);
      for (std::size_t j = 0; j < height; ++j) {
        const std::size_t first = k2 + j > k1 ? k2 + j - k1 : 0;
        const std::size_t last = std::min(wide, rows.dft_length / 2 + 1 - (k2 + j) - k1);
        const std::size_t begin = domain.row_begin(k2 + j) + k1 - (k2 + j);
        for (std::size_t i = first; i < last; ++i) store(begin + i, j * wide + i, sums);
      }
    }
  }
}

inline void sum_all_triples(const SpectrumRows& rows, const TripleOutputs& outputs) {
  static constexpr TileKernel kTriples[kTileHigh] = {
      sum_triple_tile<kTileWide, 1>, sum_triple_tile<kTileWide, 2>, sum_triple_tile<kTileWide, 3>};
  sweep<kTileWide>(rows, kTriples, [&](std::size_t at, std::size_t i, const double* sums) {
    outputs.real[at] = sums[2 * i];
    outputs.imaginary[at] = sums[2 * i + 1];
  });
  static constexpr TileKernel kPowers[4] = {
      sum_power_tile<kPowerTileWide, 1>, sum_power_tile<kPowerTileWide, 2>,
      sum_power_tile<kPowerTileWide, 3>, sum_power_tile<kPowerTileWide, 4>};
  sweep<kPowerTileWide>(rows, kPowers, [&](std::size_t at, std::size_t i, const double* sums) {
    outputs.power12[at] = sums[i];
  });
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_TRIPLE_TILE_INL
