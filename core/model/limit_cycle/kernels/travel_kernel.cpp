#include "core/model/limit_cycle/kernels/travel_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "core/model/limit_cycle/kernels/travel_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <hwy/highway.h>

#include "core/model/vectors/eight_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model::HWY_NAMESPACE {
namespace {

/// No lag waits for another.
void lag(std::span<const EightNumbers> flows, EightNumbers* const* lagged) {
  constexpr std::size_t kLags = kTravelPoles.size();
  for (std::size_t part = 0; part < kVectorsOfEight; ++part) {
    const EightPart start = part_of(flows[0], part);
    EightPart state[kLags];
    for (EightPart& each : state) each = start;
    for (std::size_t k = 0; k < flows.size(); ++k) {
      const EightPart flow = part_of(flows[k], part);
#pragma GCC unroll 8
      for (std::size_t i = 0; i < kLags; ++i) {
        state[i] += (1.0 - kTravelPoles[i]) * (flow - state[i]);
        put_part(lagged[i][k], part, state[i] - start);
      }
    }
  }
}

TravelSums sum(const EightNumbers* lagged, std::size_t delay, std::span<const Range> ranges,
               const double* trend, const double* pv) {
  TravelSums result;
  for (std::size_t part = 0; part < kVectorsOfEight; ++part) {
    EightPart sum{}, with_trend{}, square{}, with_pv{};
    for (const Range& range : ranges) {
      for (std::size_t k = range.first; k < range.end; ++k) {
        const EightPart flow = part_of(lagged[k < delay ? 0 : k - delay], part);
        sum += flow;
        with_trend += trend[k] * flow;
        square += flow * flow;
        with_pv += flow * pv[k];
      }
    }
    put_part(result.sum, part, sum);
    put_part(result.with_trend, part, with_trend);
    put_part(result.square, part, square);
    put_part(result.with_pv, part, with_pv);
  }
  return result;
}

constexpr TravelKernel kTravelKernel{lag, sum};

}  // namespace

const TravelKernel* travel_kernel() {
  return &kTravelKernel;
}

}  // namespace loopscope::core::model::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(travel_kernel);

const TravelKernel& best_travel_kernel() {
  return *HWY_DYNAMIC_DISPATCH(travel_kernel)();
}

}  // namespace loopscope::core::model

#endif
