#pragma once

#include "core/model/answer_batch.hpp"
#include "core/model/lane_basis.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

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

/// What valves have in common that go side by side.
inline auto company(const ValveAndProcess& one) {
  const Valve& valve = one.valve->valve();
  const bool sampled = valve.acts_at_samples();
  // Where a stem begins is a lane's own; the steps of op depend on it.
  const double direction = sampled ? valve.start_direction : 0.0;
  return std::tuple(sampled, valve.law, direction, one.process->delay_samples);
}

/// The places of the valves, those of one company one after the other.
inline std::vector<std::size_t> by_company(std::span<const ValveAndProcess> valves) {
  std::vector<std::size_t> places(valves.size());
  std::iota(places.begin(), places.end(), 0U);
  std::ranges::stable_sort(places, {}, [&](std::size_t i) { return company(valves[i]); });
  return places;
}

/// A record's valves, as many together as there are lanes of Number.
template <typename Number>
class Batches {
 public:
  using Element = typename ElementOf<Number>::type;

  Batches(BatchRecord<Element> shared, std::span<const double> op,
          std::span<const ValveAndProcess> valves)
      : shared_(std::move(shared)), op_(op), valves_(valves), products_(valves.size()) {}

  std::vector<Eigen::MatrixXd> run() {
    const std::vector<std::size_t> places = by_company(valves_);
    for (std::size_t at = 0; at < places.size();) {
      std::size_t count = 1;
      while (count < kLanes<Number> && at + count < places.size() &&
             company(valves_[places[at + count]]) == company(valves_[places[at]]))
        ++count;
      run_together(std::span(places).subspan(at, count));
      at += count;
    }
    return std::move(products_);
  }

 private:
  void run_together(std::span<const std::size_t> places) {
    const Valve& valve = valves_[places.front()].valve->valve();
    if (valve.acts_at_samples()) {
      see_steps(valve.start_direction);
      with_law(valve.law, [&]<ValveLaw law>() {
        put_products<SampledBatch<Number, kVectorsAtOnce<Number>, law>>(places);
      });
    } else if (valve.law == ValveLaw::he) {
      put_products<StemBatch<Number, kVectorsAtOnce<Number>, ValveLaw::he>>(places);
    } else {
      put_products<StemBatch<Number, kVectorsAtOnce<Number>, ValveLaw::kano>>(places);
    }
  }

  void see_steps(double direction) {
    if (direction == seen_from_) return;
    seen_from_ = direction;
    shared_.seen.steps = steps_of<Element>(op_, direction);
  }

  template <typename Batch>
  void put_products(std::span<const std::size_t> places) {
    std::vector<ValveAndProcess> together;
    for (const std::size_t place : places) together.push_back(valves_[place]);
    AnswerBatch<Number, Batch> batch(shared_, together);
    batch.run();
    for (std::size_t lane = 0; lane < places.size(); ++lane)
      products_[places[lane]] = batch.products(lane);
  }

  BatchRecord<Element> shared_;
  std::span<const double> op_;
  std::span<const ValveAndProcess> valves_;
  std::vector<Eigen::MatrixXd> products_;
  double seen_from_ = 0.0;  ///< the direction of the steps; 0 = there are none yet
};

/// ValveAnswers::products(), in so many Numbers.
template <typename Number>
std::vector<Eigen::MatrixXd> products_in(const AnswerTask& task,
                                         std::span<const ValveAndProcess> valves) {
  using Element = typename ElementOf<Number>::type;
  BatchRecord<Element> shared{task.noise, task.taps, task.rows, {}, {}};
  shared.seen.op.assign(task.op.begin(), task.op.end());
  for (const Signal signal : task.steady)
    shared.columns.emplace_back(signal, signal + task.op.size());
  return Batches<Number>(std::move(shared), task.op, valves).run();
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
