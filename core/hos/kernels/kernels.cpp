#include "core/hos/kernels/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/hos/kernels/kernels.cpp"  // this file, once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <hwy/highway.h>

#include "core/hos/kernels/bic2-inl.hpp"
#include "core/hos/kernels/dot_products-inl.hpp"
#include "core/hos/kernels/record_sums-inl.hpp"
#include "core/hos/kernels/row_scans-inl.hpp"
#include "core/hos/kernels/segment_dft-inl.hpp"
#include "core/hos/kernels/triple_tile-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::hos::HWY_NAMESPACE {
namespace {

constexpr std::string_view kName = HWY_TARGET == HWY_AVX3   ? "avx512"
                                   : HWY_TARGET == HWY_AVX2 ? "avx2"
                                   : HWY_TARGET == HWY_SSE4 ? "sse4"
                                   : HWY_TARGET == HWY_NEON ? "neon"
                                                            : "portable";

constexpr Kernels kKernels{
    kName,           scan_magnitude,     transform_segments,   sum_each_row,
    sum_all_triples, normalise_triples,  sum_values,           sum_square_deviations,
    sum_powers,      sum_trend,          taper_record,         sum_differences,
    sum_pairs,       predict_each_other, subtract_predictions, sum_lags,
    apply_taps,      weigh_rows};

}  // namespace

const Kernels* kernels() {
  return &kKernels;
}

}  // namespace loopscope::core::hos::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::hos {

HWY_EXPORT(kernels);

const Kernels& best_kernels() {
  return *HWY_DYNAMIC_DISPATCH(kernels)();
}

}  // namespace loopscope::core::hos

#endif
