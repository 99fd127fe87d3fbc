#include "core/model/valve_law/valve_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/model/valve_law/valve_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <hwy/highway.h>

#include "core/model/valve_law/valve_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Four valves that see op alike.
class FourValves {
 public:
  /// Fewer are followed by the last of them once more.
  FourValves(std::span<const Valve> valves, double op) : motion_{op, valves[0].start_direction} {
    for (std::size_t lane = 0; lane < kFour; ++lane)
      valves_.put_in(lane, valves[std::min(lane, valves.size() - 1)], op, friction_);
  }
  template <ValveLaw law>
  void step(double op) {
    valves_.template step<law>(friction_, motion_.take(op));
  }
  void write(double* positions) const {
    std::memcpy(positions, &valves_.position, sizeof(valves_.position));
  }
  static constexpr std::size_t kFour = kSideBySide / 2;

 private:
  static constexpr std::size_t kBytes =
      std::min(longest_vector_bytes(HWY_TARGET), kFour * sizeof(double));
  using Number __attribute__((vector_size(kBytes))) = double;
  using Lanes = ValveLanes<Number, kFour * sizeof(double) / kBytes>;
  Lanes valves_;
  typename Lanes::Frictions friction_{};
  OpMotion<double> motion_;
};

/// Both by value: what they stand on stays in registers.
template <ValveLaw law>
void follow(FourValves left, FourValves right, std::span<const double> op,
            std::span<EightNumbers> mv) {
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (!std::isnan(op[k])) {
      left.step<law>(op[k]);
      right.step<law>(op[k]);
    }
    left.write(mv[k].numbers);
    right.write(mv[k].numbers + FourValves::kFour);
  }
}

void follow_eight(std::span<const Valve> valves, std::span<const double> op,
                  std::span<EightNumbers> mv) {
  const std::size_t half = std::min(valves.size(), FourValves::kFour);
  const FourValves left(valves.first(half), op[0]);
  const FourValves right(half < valves.size() ? valves.subspan(half) : valves, op[0]);
  with_law(valves[0].law, [&]<ValveLaw law>() { follow<law>(left, right, op, mv); });
}

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(follow_eight);

void follow_valves(std::span<const Valve> valves, std::span<const double> op,
                   std::span<EightNumbers> mv) {
  HWY_DYNAMIC_DISPATCH(follow_eight)(valves, op, mv);
}

}  // namespace loopscope::core::model

#endif
