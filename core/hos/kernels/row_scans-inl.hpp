// Looks along whole records and rows.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_ROW_SCANS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_ROW_SCANS_INL
#undef LOOPSCOPE_HOS_ROW_SCANS_INL
#else
#define LOOPSCOPE_HOS_ROW_SCANS_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <hwy/highway.h>
#include <span>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/numeric/magnitude.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

MagnitudeScan scan_magnitude(std::span<const double> signal) {
  constexpr std::size_t kChains = 4;
  // Zero as long as every sample is finite: infinity less itself is NaN, and stays.
  Vector trace[kChains] = {};
  Vector largest[kChains] = {};
  std::size_t n = 0;
  for (; n + kChains * kWidth <= signal.size(); n += kChains * kWidth) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kChains; ++i) {
      const Vector sample = load_anywhere(signal.data() + n + i * kWidth);
      trace[i] += sample - sample;
      largest[i] = hn::Max(hn::Abs(sample), largest[i]);
    }
  }
  MagnitudeScan found;
  alignas(kAlignment) double traces[kChains * kWidth];
  alignas(kAlignment) double sizes[kChains * kWidth];
  for (std::size_t i = 0; i < kChains; ++i) {
    store(traces + i * kWidth, trace[i]);
    store(sizes + i * kWidth, largest[i]);
  }
  for (std::size_t i = 0; i < kChains * kWidth; ++i) {
    found.complete = found.complete && traces[i] == 0.0;
    found.largest = std::max(found.largest, sizes[i]);
  }
  if (!found.complete) return {largest_magnitude(signal), false};
  for (; n < signal.size(); ++n) {
    found.complete = found.complete && std::isfinite(signal[n]);
    if (std::isfinite(signal[n])) found.largest = std::max(found.largest, std::abs(signal[n]));
  }
  return found;
}

HWY_INLINE Vector sum_along(const double* row, std::size_t length) {
  Vector sum = hn::Zero(Tag());
  for (std::size_t s = 0; s < length; s += kWidth) sum += load(row + s);
  return sum;
}

void sum_each_row(const Rows& rows, double* sums) {
  alignas(kAlignment) double lanes[kWidth];
  for (std::size_t k = 0; k < rows.count; k += kWidth) {
    const std::size_t count = std::min(kWidth, rows.count - k);
    Vectors<kWidth> partial{};
    for (std::size_t i = 0; i < count; ++i) {
      partial.at[i] = sum_along(rows.first + (k + i) * rows.stride, rows.length);
    }
    sum_lanes(partial, lanes);
    std::copy_n(lanes, count, sums + k);
  }
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_ROW_SCANS_INL
