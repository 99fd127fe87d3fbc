// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_RESPONSE_BATCHES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_RESPONSE_BATCHES_INL
#undef LOOPSCOPE_MODEL_RESPONSE_BATCHES_INL
#else
#define LOOPSCOPE_MODEL_RESPONSE_BATCHES_INL
#endif

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <hwy/highway.h>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/model/fit/batched/lane_kernel.hpp"
#include "core/model/fit/batched/response_batch-inl.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

template <typename Element>
std::vector<OpStep<Element>> steps_of(std::span<const double> op, double direction) {
  std::vector<OpStep<Element>> steps;
  steps.reserve(op.size());
  OpMotion<double> motion{op.front(), direction};
  const auto few = [](double value) { return static_cast<Element>(value); };
  for (const double value : op) {
    const OpStep<double> step = motion.take(value);
    steps.push_back(
        {few(step.op), few(step.before), few(step.direction), few(step.kept), few(step.turned)});
  }
  return steps;
}

/// What valves have in common that go side by side, and what they had better have.
struct BatchKey {
  bool sampled;
  ValveLaw law;
  double
      direction;  ///< of a stem none: where it begins is a lane's own; the steps of op depend on it
  std::size_t delay_samples;
  double band;  ///< stems of about the same one rest together

  explicit BatchKey(const ValveAndProcess& one)
      : sampled(one.valve->valve().acts_at_samples()),
        law(one.valve->valve().law),
        direction(sampled ? one.valve->valve().start_direction : 0.0),
        delay_samples(one.process->delay_samples),
        band(sampled ? 0.0 : one.valve->valve().stickband_percent) {}
  [[nodiscard]] bool same_batch(const BatchKey& other) const {
    return sampled == other.sampled && law == other.law && direction == other.direction &&
           delay_samples == other.delay_samples;
  }
  [[nodiscard]] bool operator<(const BatchKey& other) const {
    return std::tie(delay_samples, band, sampled, law, direction) <
           std::tie(other.delay_samples, other.band, other.sampled, other.law, other.direction);
  }
};

/// A record's valves, as many together as there are lanes of Number.
template <typename Number>
class Batches {
 public:
  using Element = typename ElementOf<Number>::type;

  Batches(BatchRecord<Element> shared, std::span<const double> op,
          std::span<const ValveAndProcess> valves)
      : shared_(std::move(shared)), op_(op), valves_(valves), products_(valves.size()) {}

  std::vector<Eigen::MatrixXd> run() {
    std::vector<Place> places;
    for (std::size_t i = 0; i < valves_.size(); ++i) places.emplace_back(BatchKey(valves_[i]), i);
    std::ranges::sort(places);
    for (std::size_t at = 0; at < places.size();) {
      std::size_t count = 1;
      while (count < kLanes<Number> && at + count < places.size() &&
             places[at + count].first.same_batch(places[at].first))
        ++count;
      run_together(std::span(places).subspan(at, count));
      at += count;
    }
    return std::move(products_);
  }

 private:
  using Place = std::pair<BatchKey, std::size_t>;  ///< of a valve among all

  void run_together(std::span<const Place> places) {
    const Valve& valve = valves_[places.front().second].valve->valve();
    if (valve.acts_at_samples()) see_steps(valve.start_direction);
    with_law(valve.law, [&]<ValveLaw law>() {
      constexpr std::size_t kOne = kElements<Number>;
      if (places.size() <= kOne) return put_products<1, law>(places);
      if (places.size() <= 2 * kOne) return put_products<2, law>(places);
      put_products<kVectorsAtOnce, law>(places);
    });
  }

  void see_steps(double direction) {
    if (direction == seen_from_) return;
    seen_from_ = direction;
    shared_.seen.steps = steps_of<Element>(op_, direction);
  }

  /// In as many vectors as they fill.
  template <std::size_t vectors, ValveLaw law>
  void put_products(std::span<const Place> places) {
    if (places.front().first.sampled) {
      SampledBatch<Number, vectors, law> valves(shared_.seen);
      put_products_of<vectors>(places, valves);
    } else if constexpr (law != ValveLaw::choudhury) {
      StemBatch<Number, vectors, law> valves(shared_.seen);
      put_products_of<vectors>(places, valves);
    }
  }

  template <std::size_t vectors>
  void put_products_of(std::span<const Place> places,
                       ValveBatch<NumberRow<Number, vectors>>& valves) {
    std::vector<ValveAndProcess> together;
    for (const Place& place : places) together.push_back(valves_[place.second]);
    ResponseBatch<Number, vectors> batch(shared_, valves, together);
    batch.run();
    for (std::size_t lane = 0; lane < places.size(); ++lane)
      products_[places[lane].second] = batch.products(lane);
  }

  BatchRecord<Element> shared_;
  std::span<const double> op_;
  std::span<const ValveAndProcess> valves_;
  std::vector<Eigen::MatrixXd> products_;
  double seen_from_ = 0.0;  ///< the direction of the steps; 0 = there are none yet
};

/// ValveResponses::products(), in so many Numbers.
template <typename Number>
std::vector<Eigen::MatrixXd> products_in(const ResponseTask& task,
                                         std::span<const ValveAndProcess> valves) {
  using Element = typename ElementOf<Number>::type;
  BatchRecord<Element> shared{task.noise, task.taps, task.rows, {}, {}};
  shared.seen.op.assign(task.op.begin(), task.op.end());
  for (const Signal signal : task.steady)
    shared.columns.emplace_back(signal, signal + task.op.size());
  return Batches<Number>(std::move(shared), task.op, valves).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_RESPONSE_BATCHES_INL
