// Squared bicoherence out of its sums, and what the indices need of it.
//
// Compiled once for each kind of processor, like lanes-inl.hpp.
#if defined(LOOPSCOPE_HOS_BIC2_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_HOS_BIC2_INL
#undef LOOPSCOPE_HOS_BIC2_INL
#else
#define LOOPSCOPE_HOS_BIC2_INL
#endif

#include <algorithm>
#include <cstddef>
#include <hwy/highway.h>
#include <span>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/kernels/lanes-inl.hpp"
#include "core/hos/kernels/principal_domain.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {

/// Neighbours along one k2, the lanes of a vector or a single one.
struct Bic2Row {
  const double* real;
  const double* imaginary;
  const double* power12;
  const double* power1;  ///< of k1
  const double* power3;  ///< of k1 + k2
  double* bic2;
};

/// Those from i on; returns their denominators.
HWY_INLINE Vector normalise_lanes(const Bic2Row& row, std::size_t i) {
  const Vector zero = hn::Zero(Tag());
  const Vector one = broadcast(1.0);
  const Vector power12 =
      hn::IfThenElseZero(load_anywhere(row.power1 + i) > zero, load_anywhere(row.power12 + i));
  const Vector denominator = power12 * load_anywhere(row.power3 + i);
  const auto defined = denominator > zero;
  const Vector re = load_anywhere(row.real + i);
  const Vector im = load_anywhere(row.imaginary + i);
  // Rounding may lift a perfectly coupled triple a few units above 1.
  const Vector value =
      hn::Min(one, (re * re + im * im) / hn::IfThenElse(defined, denominator, one));
  store_anywhere(row.bic2 + i, hn::IfThenElseZero(defined, value));
  return denominator;
}

/// The same of one.
HWY_INLINE double normalise_one(const Bic2Row& row, std::size_t i) {
  const double denominator = row.power1[i] > 0.0 ? row.power12[i] * row.power3[i] : 0.0;
  const double size = row.real[i] * row.real[i] + row.imaginary[i] * row.imaginary[i];
  row.bic2[i] = denominator > 0.0 ? std::min(1.0, size / denominator) : 0.0;
  return denominator;
}

bool normalise_triples(const TripleOutputs& sums, const double* total_power, std::size_t dft_length,
                       double* bic2) {
  const PrincipalDomain domain(dft_length);
  Vector largest = hn::Zero(Tag());
  double largest_alone = 0.0;
  for (std::size_t k2 = 1; k2 <= domain.rows(); ++k2) {
    const std::size_t at = domain.row_begin(k2);
    const std::size_t count = domain.row_size(k2);
    if (!(total_power[k2] > 0.0)) {
      std::fill_n(bic2 + at, count, 0.0);
      continue;
    }
    const Bic2Row row{sums.real + at,   sums.imaginary + at,  sums.power12 + at,
                      total_power + k2, total_power + 2 * k2, bic2 + at};
    if (count < kWidth) {
      for (std::size_t i = 0; i < count; ++i) {
        largest_alone = std::max(largest_alone, normalise_one(row, i));
      }
      continue;
    }
    // The last vector takes some for the second time.
    for (std::size_t i = 0; i < count; i += kWidth) {
      largest = hn::Max(largest, normalise_lanes(row, std::min(i, count - kWidth)));
    }
  }
  alignas(kAlignment) double lanes[kWidth];
  store(lanes, largest);
  return std::max(largest_alone, *std::max_element(lanes, lanes + kWidth)) > 0.0;
}

/// Sum and maximum of f(value) in kLanes running ones whatever the width, so that every kind of
/// processor gives the same digits.
template <class Function, class OneFunction>
HWY_INLINE ValueTotals sum_over(std::span<const double> values, const Function& f,
                                const OneFunction& f_of_one) {
  constexpr std::size_t kVectors = kLanes / kWidth;
  Vector sums[kVectors] = {};
  Vector largest[kVectors] = {};
  std::size_t n = 0;
  for (; n + kLanes <= values.size(); n += kLanes) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kVectors; ++i) {
      const Vector value = f(load_anywhere(values.data() + n + i * kWidth));
      sums[i] += value;
      largest[i] = hn::Max(largest[i], value);
    }
  }
  ValueTotals totals;
  for (; n < values.size(); ++n) {
    const double value = f_of_one(values[n]);
    totals.sum += value;
    totals.largest = std::max(totals.largest, value);
  }
  alignas(kAlignment) double lane_sums[kLanes];
  alignas(kAlignment) double lane_largest[kLanes];
  for (std::size_t i = 0; i < kVectors; ++i) {
    store(lane_sums + i * kWidth, sums[i]);
    store(lane_largest + i * kWidth, largest[i]);
  }
  for (const double sum : lane_sums) totals.sum += sum;
  totals.largest = std::max(totals.largest, *std::max_element(lane_largest, lane_largest + kLanes));
  return totals;
}

ValueTotals sum_values(std::span<const double> values) {
  return sum_over(
      values, [](Vector value) { return value; }, [](double value) { return value; });
}

double sum_square_deviations(std::span<const double> values, double mean) {
  const Vector means = broadcast(mean);
  return sum_over(
             values, [=](Vector value) { return (value - means) * (value - means); },
             [=](double value) { return (value - mean) * (value - mean); })
      .sum;
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_HOS_BIC2_INL
