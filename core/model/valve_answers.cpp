#include "core/model/valve_answers.hpp"

#include "core/model/number_pair.hpp"
#include "core/model/valve_batch.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::MatrixXd;

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

bool alike(const ValveEffect& a, const ValveEffect& b) {
  return a.valve().law == b.valve().law && a.valve().start_direction == b.valve().start_direction;
}

template <typename Number>
void add_products(const BatchRecord<typename ElementOf<Number>::type>& shared,
                  std::span<const ValveEffect* const> valves, std::vector<MatrixXd>& result) {
  ValveBatch<Number> batch(shared, valves);
  with_law(valves.front()->valve().law, [&]<ValveLaw law>() { batch.template run<law>(); });
  for (std::size_t lane = 0; lane < valves.size(); ++lane) result.push_back(batch.products(lane));
}

template <typename Number>
std::vector<MatrixXd> all_products(std::span<const double> op, const Structure& structure,
                                   std::span<const Signal> steady, std::span<const Range> rows,
                                   std::span<const ValveEffect* const> valves) {
  using Element = typename ElementOf<Number>::type;
  std::vector<MatrixXd> result;
  BatchRecord<Element> shared{structure, rows, op.size(), {}, {}};
  for (const Signal signal : steady) shared.columns.emplace_back(signal, signal + op.size());
  double direction = 0.0;
  for (std::size_t at = 0; at < valves.size();) {
    const ValveEffect& first = *valves[at];
    if (first.valve().start_direction != direction)
      shared.steps = steps_of<Element>(op, direction = first.valve().start_direction);
    std::size_t count = 1;
    while (count < ValveBatch<Number>::kLanes && at + count < valves.size() &&
           alike(first, *valves[at + count]))
      ++count;
    add_products<Number>(shared, valves.subspan(at, count), result);
    at += count;
  }
  return result;
}

}  // namespace

ValveAnswers::ValveAnswers(std::span<const double> op, const Structure& structure,
                           std::span<const Signal> steady, std::span<const Range> rows)
    : op_(op), structure_(structure), steady_(steady), rows_(rows) {}

std::vector<MatrixXd> ValveAnswers::products(std::span<const ValveEffect* const> valves,
                                             Digits digits) const {
  return digits == Digits::full
             ? all_products<NumberPair>(op_, structure_, steady_, rows_, valves)
             : all_products<ShortNumbers>(op_, structure_, steady_, rows_, valves);
}

}  // namespace loopscope::core::model
