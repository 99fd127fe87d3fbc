// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_VALVE_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_VALVE_BATCH_INL
#undef LOOPSCOPE_MODEL_VALVE_BATCH_INL
#else
#define LOOPSCOPE_MODEL_VALVE_BATCH_INL
#endif

#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <span>
#include <vector>

#include "core/model/valve_law/stem_lanes-inl.hpp"
#include "core/model/valve_law/valve_lanes-inl.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// op as all valves see it, in the digits of their numbers.
template <typename Element>
struct SeenOp {
  std::vector<Element> op;
  std::vector<OpStep<Element>> steps;  ///< for valves that act at the samples
};

/// Valves side by side, whatever their law: what is done with their places is compiled once for all
/// laws, a call for each stretch of samples.
template <typename Numbers>
class ValveBatch {
 public:
  virtual void put_in(std::size_t lane, const Valve& valve) = 0;
  /// Where the valves are at so many samples from `first` on.
  virtual void run(std::size_t first, std::size_t samples, Numbers* places) = 0;

 protected:
  ~ValveBatch() = default;
};

/// Valves side by side that act at the samples, of one law and direction at the start, each lane
/// with its own friction. Number is NumberPair or ShortNumbers.
template <typename Number, std::size_t count, ValveLaw law>
class SampledBatch final : public ValveBatch<NumberRow<Number, count>> {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, count>;

  explicit SampledBatch(const SeenOp<Element>& seen) : steps_(seen.steps) {}

  void put_in(std::size_t lane, const Valve& valve) override {
    valves_.put_in(lane, valve, steps_.front().op, friction_);
  }

  void run(std::size_t first, std::size_t samples, Numbers* places) override {
    ValveLanes<Number, count> valves = valves_;
    const OpStep<Element>* steps = &steps_[first];
    for (std::size_t k = 0; k < samples; ++k) {
      valves.template step<law>(friction_, steps[k]);
      places[k] = valves.position;
    }
    valves_ = valves;
  }

 private:
  std::span<const OpStep<Element>> steps_;
  std::array<FrictionIn<Number>, count> friction_{};
  ValveLanes<Number, count> valves_;
};

/// The same of stems between the samples, each lane with its own lags too. Law `he` or `kano`.
template <typename Number, std::size_t count, ValveLaw law>
class StemBatch final : public ValveBatch<NumberRow<Number, count>> {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, count>;

  explicit StemBatch(const SeenOp<Element>& seen) : op_(seen.op) {}

  void put_in(std::size_t lane, const Valve& valve) override {
    stems_.put_in(lane, valve, static_cast<double>(op_.front()));
  }
  void run(std::size_t first, std::size_t samples, Numbers* places) override {
    stems_.template run<law>(op_.subspan(first, samples), places);
  }

 private:
  std::span<const Element> op_;
  StemLanes<Number, count> stems_;
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_VALVE_BATCH_INL
