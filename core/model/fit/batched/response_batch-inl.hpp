// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_RESPONSE_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_RESPONSE_BATCH_INL
#undef LOOPSCOPE_MODEL_RESPONSE_BATCH_INL
#else
#define LOOPSCOPE_MODEL_RESPONSE_BATCH_INL
#endif

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <hwy/highway.h>
#include <span>
#include <vector>

#include "core/model/fit/batched/lane_kernel.hpp"
#include "core/model/fit/batched/response_lanes-inl.hpp"
#include "core/model/fit/batched/response_sums-inl.hpp"
#include "core/model/fit/batched/valve_batch-inl.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/response/noise_model.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Numbers side by side: they hide what each of them waits for. Of 2, 3 and 4 the last is fastest.
inline constexpr std::size_t kVectorsAtOnce = 4;
template <typename Number>
inline constexpr std::size_t kLanes = kElements<Number>* kVectorsAtOnce;

/// What every batch shares, in the digits of its numbers.
template <typename Element>
struct BatchRecord {
  const NoiseModel& noise;
  std::size_t taps = 1;
  std::span<const Range> rows;
  SeenOp<Element> seen;
  std::vector<std::vector<Element>> columns;  ///< the steady ones
  [[nodiscard]] std::size_t samples() const { return seen.op.size(); }
};

/// Valves and processes side by side, from op to their sums; dead time and integrator are those of
/// the first one. As few as there are: what is left of the lanes repeats the last one.
template <typename Number, std::size_t vectors>
class ResponseBatch {
 public:
  using Element = typename ElementOf<Number>::type;
  using Numbers = NumberRow<Number, vectors>;

  /// `valves`: of `shared.seen`, which this fills with `all`.
  ResponseBatch(const BatchRecord<Element>& shared, ValveBatch<Numbers>& valves,
                std::span<const ValveAndProcess> all)
      : shared_(shared),
        delay_(std::min(all.front().process->delay_samples, shared.samples())),
        valves_(valves),
        sums_(shared.rows, shared.columns, shared.taps) {
    for (std::size_t lane = 0; lane < vectors * kElements<Number>; ++lane) {
      const ValveAndProcess& one = all[std::min(lane, all.size() - 1)];
      valves_.put_in(lane, one.valve->valve());
      poles_.put(lane, *one.process);
    }
  }

  void run() {
    Numbers start;
    move_on(1, &start);
    AnswerLanes<Number, vectors> answers(poles_, shared_.noise, start);
    // The sample before a stretch stands in front of it: the second tap is a sample later.
    std::array<Numbers, kStretch + 1> x{};
    for (std::size_t first = 0; first < shared_.samples(); first += kStretch) {
      const std::size_t count = std::min(kStretch, shared_.samples() - first);
      // The dead time: until then the valves are where they began.
      const std::size_t waiting = std::min(count, delay_ + 1 - std::min(delay_ + 1, first));
      std::fill_n(&x[1], waiting, start);
      move_on(count - waiting, x.data() + 1 + waiting);  // nothing is left where all wait
      answers.run(&x[1], count);
      if (first == 0) x[0] = x[1];
      sums_.add(first, count, x.data());
      x[0] = x[count];
    }
  }

  /// Of one lane, see ValveResponses.
  [[nodiscard]] Eigen::MatrixXd products(std::size_t lane) const {
    Eigen::MatrixXd result = sums_.products(lane);
    result *= poles_.gain[lane];
    result.rightCols(result.rows()) *= poles_.gain[lane];
    return result;
  }

 private:
  /// Samples at a time: few enough to stay near the processor between the steps.
  static constexpr std::size_t kStretch = 64;

  /// Where the valves are at the next samples of op.
  void move_on(std::size_t count, Numbers* places) {
    if (count == 0) return;
    valves_.run(now_, count, places);
    now_ += count;
  }

  const BatchRecord<Element>& shared_;
  std::size_t delay_;
  ValveBatch<Numbers>& valves_;
  PoleLanes<Number, vectors> poles_;
  AnswerSums<Number, vectors> sums_;
  std::size_t now_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_RESPONSE_BATCH_INL
