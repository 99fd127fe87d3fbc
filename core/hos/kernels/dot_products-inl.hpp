// Series against a few fixed weights, at one place or at many.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_DOT_PRODUCTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_DOT_PRODUCTS_INL
#undef LOOPSCOPE_HOS_DOT_PRODUCTS_INL
#else
#define LOOPSCOPE_HOS_DOT_PRODUCTS_INL
#endif

#include <cstddef>
#include <hwy/highway.h>
#include <span>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/record_sums.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

/// x(n) - a_1 x(n - 1) - ... - a_order x(n - order), n = 0 .. count - 1; x(-order) is readable.
void subtract_predictions(const double* x, std::size_t count, std::span<const double> a,
                          double* errors) {
  std::size_t n = 0;
  for (; n + kWidth <= count; n += kWidth) {
    Vector error = load_anywhere(x + n);
    for (std::size_t i = 0; i < a.size(); ++i) {
      error = subtract_product(broadcast(a[i]), load_anywhere(x + n - (i + 1)), error);
    }
    store_anywhere(errors + n, error);
  }
  for (; n < count; ++n) {
    errors[n] = x[n];
    for (std::size_t i = 0; i < a.size(); ++i) errors[n] -= a[i] * x[n - (i + 1)];
  }
}

/// Of `count` lags from `lag` on.
template <std::size_t count>
HWY_INLINE void sum_some_lags(std::span<const double> weighted, const double* x, std::size_t lag,
                              double* sums) {
  Vectors<count> partial{};
  const double* const from = x - lag;
  std::size_t n = 0;
  for (; n + kWidth <= weighted.size(); n += kWidth) {
    const Vector weights = load_anywhere(weighted.data() + n);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < count; ++i) {
      partial.at[i] = multiply_add(weights, load_anywhere(from + n - i), partial.at[i]);
    }
  }
  alignas(kAlignment) double totals[count + kWidth];
  sum_lanes(partial, totals);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t m = n; m < weighted.size(); ++m) totals[i] += weighted[m] * *(from + m - i);
    sums[i] = totals[i];
  }
}

void sum_lags(std::span<const double> weighted, const double* x, std::span<double> sums) {
  std::size_t lag = 0;
  for (; lag + 8 <= sums.size(); lag += 8) sum_some_lags<8>(weighted, x, lag, &sums[lag]);
  for (; lag + 2 <= sums.size(); lag += 2) sum_some_lags<2>(weighted, x, lag, &sums[lag]);
  if (lag < sums.size()) sum_some_lags<1>(weighted, x, lag, &sums[lag]);
}

void apply_taps(const FilterTaps& taps, const double* x, double* outputs) {
  constexpr std::size_t kColumns = FilterTaps::kColumns;
  Vectors<kColumns> partial{};
  std::size_t n = 0;
  for (; n + kWidth <= taps.length; n += kWidth) {
    const Vector samples = load_anywhere(x + n);
    for (std::size_t i = 0; i < kColumns; ++i) {
      const Vector weights = load_anywhere(taps.first + i * taps.length + n);
      partial.at[i] = multiply_add(weights, samples, partial.at[i]);
    }
  }
  alignas(kAlignment) double sums[kColumns + kWidth];
  sum_lanes(partial, sums);
  for (std::size_t i = 0; i < kColumns; ++i) {
    outputs[i] = sums[i];
    for (std::size_t m = n; m < taps.length; ++m) {
      outputs[i] += taps.first[i * taps.length + m] * x[m];
    }
  }
}

/// sums[s] = sum over rows of weights[row] times the row's value at s.
void weigh_rows(const Rows& rows, const double* weights, double* sums) {
  for (std::size_t s = 0; s < rows.length; s += kWidth) {
    Vector even = hn::Zero(Tag());
    Vector odd = hn::Zero(Tag());
    const double* row = rows.first + s;
    std::size_t k = 0;
    for (; k + 2 <= rows.count; k += 2, row += 2 * rows.stride) {
      even = multiply_add(broadcast(weights[k]), load(row), even);
      odd = multiply_add(broadcast(weights[k + 1]), load(row + rows.stride), odd);
    }
    if (k < rows.count) even = multiply_add(broadcast(weights[k]), load(row), even);
    store_anywhere(sums + s, even + odd);
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_DOT_PRODUCTS_INL
