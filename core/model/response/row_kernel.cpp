#include "core/model/response/row_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/model/response/row_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <cstring>
#include <hwy/highway.h>

#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model::HWY_NAMESPACE {
namespace {

/// Rows side by side. Longer vectors would add in another order than the other processors.
constexpr std::size_t kTogether = 4;
using Quad __attribute__((vector_size(kTogether * sizeof(double)))) = double;

/// Where no rows are added to one another any length will do.
constexpr std::size_t kVectorBytes = longest_vector_bytes(HWY_TARGET);
using Wide __attribute__((vector_size(kVectorBytes))) = double;
constexpr std::size_t kWide = kVectorBytes / sizeof(double);

/// Signals to a tile: each loaded row serves several sums, and these fit into the registers.
constexpr std::size_t kHeight = HWY_TARGET == HWY_AVX3 ? 4 : 2;
constexpr std::size_t kWidth = kVectorBytes >= sizeof(Quad) ? 4 : 2;

template <typename Vector>
inline void load(Vector& into, Signal from) {
  std::memcpy(&into, from, sizeof(Vector));
}

template <std::size_t height, std::size_t width>
void add_tile(const Signal* left, const Signal* right, std::span<const Range> rows, double* sums,
              std::size_t stride) {
  Quad all[height][width] = {};
  double rest[height][width] = {};
  for (const Range& range : rows) {
    std::size_t k = range.first;
    for (; k + kTogether <= range.end; k += kTogether) {
      Quad b[width];
#pragma GCC unroll 4
      for (std::size_t j = 0; j < width; ++j) load(b[j], right[j] + k);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < height; ++i) {
        Quad a;
        load(a, left[i] + k);
#pragma GCC unroll 4
        for (std::size_t j = 0; j < width; ++j) all[i][j] += a * b[j];
      }
    }
    for (; k < range.end; ++k) {
      for (std::size_t i = 0; i < height; ++i) {
        for (std::size_t j = 0; j < width; ++j) rest[i][j] += left[i][k] * right[j][k];
      }
    }
  }
  for (std::size_t i = 0; i < height; ++i) {
    for (std::size_t j = 0; j < width; ++j) {
      const Quad& sum = all[i][j];
      sums[i * stride + j] += rest[i][j] + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
    }
  }
}

/// So many of the left with all of the right.
template <std::size_t height>
void add_band(const Signal* left, std::span<const Signal> right, std::span<const Range> rows,
              double* sums, std::size_t stride) {
  std::size_t j = 0;
  for (; j + kWidth <= right.size(); j += kWidth)
    add_tile<height, kWidth>(left, &right[j], rows, sums + j, stride);
  for (; j + 2 <= right.size(); j += 2)
    add_tile<height, 2>(left, &right[j], rows, sums + j, stride);
  for (; j < right.size(); ++j) add_tile<height, 1>(left, &right[j], rows, sums + j, stride);
}

void add_products(std::span<const Signal> left, std::span<const Signal> right,
                  std::span<const Range> rows, double* sums, std::size_t stride) {
  std::size_t i = 0;
  for (; i + kHeight <= left.size(); i += kHeight)
    add_band<kHeight>(&left[i], right, rows, sums + i * stride, stride);
  for (; i + 2 <= left.size(); i += 2)
    add_band<2>(&left[i], right, rows, sums + i * stride, stride);
  for (; i < left.size(); ++i) add_band<1>(&left[i], right, rows, sums + i * stride, stride);
}

/// From `count` signals: each loaded row of a column serves all of them, and what one of their sums
/// waits for is hidden by the others.
template <std::size_t count>
void subtract_from(std::span<const Signal> columns, const double* coefficients, std::size_t rows,
                   double* const* from) {
  constexpr std::size_t kVectors = 2;
  const std::size_t stride = columns.size();
  std::size_t r = 0;
  for (; r + kVectors * kWide <= rows; r += kVectors * kWide) {
    Wide sums[count][kVectors] = {};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      Wide row[kVectors];
      for (std::size_t v = 0; v < kVectors; ++v) load(row[v], columns[i] + r + v * kWide);
#pragma GCC unroll 4
      for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t v = 0; v < kVectors; ++v)
          sums[j][v] += coefficients[j * stride + i] * row[v];
      }
    }
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t v = 0; v < kVectors; ++v) {
        double* const at = from[j] + r + v * kWide;
        Wide left;
        load(left, at);
        left -= sums[j][v];
        std::memcpy(at, &left, sizeof(Wide));
      }
    }
  }
  for (; r < rows; ++r) {
    for (std::size_t j = 0; j < count; ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < columns.size(); ++i)
        sum += coefficients[j * stride + i] * columns[i][r];
      from[j][r] -= sum;
    }
  }
}

void subtract(std::span<const Signal> columns, const double* coefficients, std::size_t rows,
              std::span<double* const> from) {
  std::size_t j = 0;
  for (; j + 4 <= from.size(); j += 4)
    subtract_from<4>(columns, coefficients + j * columns.size(), rows, &from[j]);
  for (; j < from.size(); ++j)
    subtract_from<1>(columns, coefficients + j * columns.size(), rows, &from[j]);
}

constexpr RowKernel kRowKernel{add_products, subtract};

}  // namespace

const RowKernel* row_kernel() {
  return &kRowKernel;
}

}  // namespace loopscope::core::model::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(row_kernel);

const RowKernel& best_row_kernel() {
  return *HWY_DYNAMIC_DISPATCH(row_kernel)();
}

}  // namespace loopscope::core::model

#endif
