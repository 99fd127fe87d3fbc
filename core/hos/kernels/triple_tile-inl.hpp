// Sums of triple products over the whole principal domain, tile by tile.
//
// X(k1) X(k2) takes three multiplications instead of four (Gauss), and with fused multiply-adds
// three instructions, since the sums and differences of b are made once for all k1:
//
//   t = b_r (a_r + a_i)      P_r = t - a_i (b_r + b_i)      P_i = t + a_r (b_i - b_r)
//
// With four for P c* that is seven instructions per bifrequency and segment where the definition
// takes eight. P c* in three would take an addition more, and where vectors are widest additions
// have no units of their own.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_TRIPLE_TILE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_TRIPLE_TILE_INL
#undef LOOPSCOPE_HOS_TRIPLE_TILE_INL
#else
#define LOOPSCOPE_HOS_TRIPLE_TILE_INL
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <utility>

#include "core/hos/kernels/domain_tiles-inl.hpp"
#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/kernels/triple_tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

/// As many running sums and operands as the registers hold, of which AVX-512 and NEON have 32 and
/// the others 16.
constexpr bool kManyRegisters = HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON;
using TripleShape = TileShape<kManyRegisters ? 2 : 1, kManyRegisters ? 5 : 4, 2>;
using PowerShape = TileShape<kManyRegisters ? 4 : 3, kManyRegisters ? 6 : 4, 1>;

/// Spectra of the k2 of one row of tiles, b_r, b_r + b_i and b_i - b_r, as a tile reads them: for
/// each vector of segments all that it needs, one after another.
struct Band {
  /// Segments at once, so that this and the rows beside it fit into the first cache.
  static constexpr std::size_t kSegments = 128;
  static constexpr std::size_t kStep = 3 * TripleShape::kHigh * kWidth;  ///< doubles a vector

  alignas(kAlignment) double values[kSegments / kWidth * kStep];
};

/// Part of the rows: segments begin .. begin + length - 1.
struct SegmentBlock {
  std::size_t begin;
  std::size_t length;
};

HWY_INLINE void fill_band(const SpectrumRows& rows, std::size_t k2, std::size_t count,
                          const SegmentBlock& block, Band& band) {
  for (std::size_t j = 0; j < count; ++j) {
    const double* const real = rows.real(k2 + j) + block.begin;
    double* to = band.values + 3 * j * kWidth;
    for (std::size_t s = 0; s < block.length; s += kWidth, to += Band::kStep) {
      const Vector re = load(real + s);
      const Vector im = load(real + rows.pitch + s);
      store(to, re);
      store(to + kWidth, re + im);
      store(to + 2 * kWidth, im - re);
    }
  }
}

struct ComplexSum {
  Vector re{};
  Vector im{};
};

/// Sums of the tile at `at`, for each k2 the real ones and then the imaginary ones.
template <std::size_t high>
void sum_triple_tile(const SpectrumRows& rows, const SegmentBlock& block, const Band& band,
                     Bifrequency at, double* sums) {
  constexpr std::size_t kWide = TripleShape::kWide;
  const std::size_t pitch = rows.pitch;
  const std::size_t stride = rows.stride();
  const double* const first = rows.real(at.k1) + block.begin;
  const double* const third = rows.real(at.k1 + at.k2) + block.begin;
  const double* second = band.values;
  ComplexSum partial[high][kWide];
  for (std::size_t s = 0; s < block.length; s += kWidth, second += Band::kStep) {
    Vector a_re[kWide];
    Vector a_im[kWide];
    Vector a_sum[kWide];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kWide; ++i) {
      a_re[i] = load(first + i * stride + s);
      a_im[i] = load(first + i * stride + pitch + s);
      a_sum[i] = a_re[i] + a_im[i];
    }
#pragma GCC unroll 8
    for (std::size_t j = 0; j < high; ++j) {
      const double* const b = second + 3 * j * kWidth;
      Vector re[kWide];
      Vector im[kWide];
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kWide; ++i) re[i] = load(b) * a_sum[i];
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kWide; ++i) {
        im[i] = multiply_add(a_re[i], load(b + 2 * kWidth), re[i]);
      }
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kWide; ++i) {
        re[i] = subtract_product(a_im[i], load(b + kWidth), re[i]);
      }
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kWide; ++i) {
        ComplexSum& sum = partial[j][i];
        const Vector c_re = load(third + (i + j) * stride + s);
        sum.re = multiply_add(re[i], c_re, sum.re);
        sum.im = multiply_add(im[i], c_re, sum.im);
        const Vector c_im = load(third + (i + j) * stride + pitch + s);
        sum.re = multiply_add(im[i], c_im, sum.re);
        sum.im = subtract_product(re[i], c_im, sum.im);
      }
    }
  }
  Vectors<high * TripleShape::kRow> totals;
#pragma GCC unroll 32
  for (std::size_t i = 0; i < kWide * high; ++i) {
    const ComplexSum& sum = partial[i / kWide][i % kWide];
    totals.at[i / kWide * TripleShape::kRow + i % kWide] = sum.re;
    totals.at[i / kWide * TripleShape::kRow + kWide + i % kWide] = sum.im;
  }
  sum_lanes(totals, sums);
}

template <std::size_t high>
void sum_power_tile(const SpectrumRows& rows, Bifrequency at, double* sums) {
  constexpr std::size_t kWide = PowerShape::kWide;
  const std::size_t stride = rows.stride();
  const double* const first = rows.real(at.k1) + 2 * rows.pitch;
  const double* const second = rows.real(at.k2) + 2 * rows.pitch;
  Vectors<kWide * high> totals{};
  for (std::size_t s = 0; s < rows.row_length; s += kWidth) {
    Vector a[kWide];
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kWide; ++i) a[i] = load(first + i * stride + s);
#pragma GCC unroll 8
    for (std::size_t j = 0; j < high; ++j) {
      const Vector b = load(second + j * stride + s);
#pragma GCC unroll 8
      for (std::size_t i = 0; i < kWide; ++i) {
        totals.at[j * kWide + i] = multiply_add(a[i], b, totals.at[j * kWide + i]);
      }
    }
  }
  sum_lanes(totals, sums);
}

/// One kernel for each height, 1 .. kHigh.
template <std::size_t... below>
constexpr auto triple_kernels(std::index_sequence<below...> /*heights*/) {
  return std::array{&sum_triple_tile<below + 1>...};
}
template <std::size_t... below>
constexpr auto power_kernels(std::index_sequence<below...> /*heights*/) {
  return std::array{&sum_power_tile<below + 1>...};
}

HWY_INLINE void add_row(const double* row, std::size_t first, std::size_t last, double* to) {
  for (std::size_t i = first; i < last; ++i) to[i] += row[i];
}

HWY_INLINE void add_triples(const SpectrumRows& rows, const SegmentBlock& block,
                            const TripleOutputs& outputs) {
  constexpr std::size_t kHigh = TripleShape::kHigh;
  static constexpr auto kKernels = triple_kernels(std::make_index_sequence<kHigh>());
  const PrincipalDomain domain(rows.dft_length);
  Band band;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read.
  for (std::size_t k2 = 1; k2 <= domain.rows(); k2 += kHigh) {
    fill_band(rows, k2, std::min(kHigh, domain.rows() + 1 - k2), block, band);
    sweep_band<TripleShape>(
        domain, k2,
        [&](std::size_t k1, std::size_t height, double* sums) {
          kKernels[height - 1](rows, block, band, {k1, k2}, sums);
        },
        [&](std::size_t place, const double* row, std::size_t first, std::size_t last) {
          add_row(row, first, last, outputs.real + place);
          add_row(row + TripleShape::kWide, first, last, outputs.imaginary + place);
        });
  }
}

HWY_INLINE void add_powers(const SpectrumRows& rows, double* power12) {
  constexpr std::size_t kHigh = PowerShape::kHigh;
  static constexpr auto kKernels = power_kernels(std::make_index_sequence<kHigh>());
  const PrincipalDomain domain(rows.dft_length);
  for (std::size_t k2 = 1; k2 <= domain.rows(); k2 += kHigh) {
    sweep_band<PowerShape>(
        domain, k2,
        [&](std::size_t k1, std::size_t height, double* sums) {
          kKernels[height - 1](rows, {k1, k2}, sums);
        },
        [&](std::size_t place, const double* row, std::size_t first, std::size_t last) {
          add_row(row, first, last, power12 + place);
        });
  }
}

inline void sum_all_triples(const SpectrumRows& rows, const TripleOutputs& outputs) {
  const std::size_t size = PrincipalDomain(rows.dft_length).size();
  std::fill_n(outputs.real, size, 0.0);
  std::fill_n(outputs.imaginary, size, 0.0);
  std::fill_n(outputs.power12, size, 0.0);
  for (std::size_t begin = 0; begin < rows.row_length; begin += Band::kSegments) {
    add_triples(rows, {begin, std::min(Band::kSegments, rows.row_length - begin)}, outputs);
  }
  add_powers(rows, outputs.power12);
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_TRIPLE_TILE_INL
