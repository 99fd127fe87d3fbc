// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_STEM_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_STEM_LANES_INL
#undef LOOPSCOPE_MODEL_STEM_LANES_INL
#else
#define LOOPSCOPE_MODEL_STEM_LANES_INL
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <limits>
#include <span>

#include "core/model/valve_law/stems-inl.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// `count` Numbers of stems side by side, a stretch of op at a time. A guess of a stem rests nine
/// samples of ten, and as long as op stays where it moves none of them only the pressures pass on.
template <typename Number, std::size_t count>
class StemLanes {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, count>;

  void put_in(std::size_t lane, const Valve& valve, double op) {
    stems_[lane / kElements<Number>].put_in(lane % kElements<Number>, valve, op);
    forget();
  }
  /// Where the stems are at each op; law `he` or `kano`.
  template <ValveLaw law>
  void run(std::span<const Element> op, Numbers* places) {
    for (std::size_t k = 0; k < op.size();) {
      const std::size_t first = k;
      while (k < op.size() && op[k] >= lowest_ && op[k] <= highest_) ++k;
      if (k > first) rest(op.subspan(first, k - first), places + first);
      if (k == op.size()) return;
      constexpr std::size_t kTogether = count % 2 == 0 ? 2 : 1;
      for (std::size_t i = 0; i < count; i += kTogether)
        Stems<Number>::template step_together<law, kTogether>(&stems_[i], op[k]);
      keep();
      places[k++] = places_;
    }
  }

 private:
  /// No op is known to leave them at rest.
  void forget() { highest_ = lowest_ - 1; }

  void rest(std::span<const Element> op, Numbers* places) {
    const Numbers standing = places_;
    Numbers pressure, left;
    for (std::size_t i = 0; i < count; ++i) {
      pressure[i] = stems_[i].pressure();
      left[i] = stems_[i].pressure_left();
    }
    for (std::size_t k = 0; k < op.size(); ++k) {
      const Number now = Number{} + op[k];
      for (std::size_t i = 0; i < count; ++i) pressure[i] = passed_on(pressure[i], left[i], now);
      places[k] = standing;
    }
    for (std::size_t i = 0; i < count; ++i) stems_[i].pressure() = pressure[i];
  }

  /// Where they are now, and which op leaves them there.
  void keep() {
    Number lowest = Number{} + std::numeric_limits<Element>::lowest();
    Number highest = Number{} + std::numeric_limits<Element>::max();
    for (std::size_t i = 0; i < count; ++i) {
      places_[i] = stems_[i].place();
      stems_[i].narrow(lowest, highest);
    }
    lowest_ = element(lowest, 0);
    highest_ = element(highest, 0);
    for (std::size_t i = 1; i < kElements<Number>; ++i) {
      lowest_ = std::max(lowest_, element(lowest, i));
      highest_ = std::min(highest_, element(highest, i));
    }
  }

  std::array<Stems<Number>, count> stems_{};
  Numbers places_{};
  Element lowest_ = 0, highest_ = 0;  ///< op that leaves all of them at rest
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_STEM_LANES_INL
