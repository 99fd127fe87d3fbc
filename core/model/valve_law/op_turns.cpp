#include "core/model/valve_law/op_turns.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::core::model {
namespace {

/// From `turn` to `end`.
void run_from(const OpTurn& turn, std::size_t end, std::span<Valve> valves,
              std::span<const double> op, std::span<EightNumbers> mv) {
  for (Valve& valve : valves) valve.start_direction = turn.direction;
  const std::size_t count = end - turn.sample;
  run_valves(valves, op.subspan(turn.sample, count), mv.subspan(turn.sample, count));
}

void stand_before(const OpTurn& turn, std::span<EightNumbers> mv) {
  std::ranges::fill(mv.first(turn.sample), mv[turn.sample]);
}

}  // namespace

std::vector<OpTurn> find_op_turns(std::span<const double> op, double prominence) {
  std::vector<OpTurn> turns;
  if (op.empty()) return turns;
  OpTurn high{0, op[0], 1.0};
  OpTurn low{0, op[0], -1.0};
  bool seek_high = true;
  bool seek_low = true;
  for (std::size_t k = 1; k < op.size(); ++k) {
    if (op[k] > high.op) high = {k, op[k], 1.0};
    if (op[k] < low.op) low = {k, op[k], -1.0};
    const bool fell = seek_high && high.op - op[k] > prominence;
    const bool rose = seek_low && op[k] - low.op > prominence;
    if (!fell && !rose) continue;
    const OpTurn& turn = fell ? high : low;
    // Where the record starts op need not have turned.
    if (turn.sample > 0) turns.push_back(turn);
    seek_high = !fell;
    seek_low = fell;
    high = {k, op[k], 1.0};
    low = {k, op[k], -1.0};
  }
  return turns;
}

void run_from_first_turn(std::vector<Valve> valves, std::span<const double> op,
                         std::span<const OpTurn> turns, std::span<EightNumbers> mv) {
  const OpTurn start = turns.empty() ? OpTurn{0, op[0], 1.0} : turns.front();
  run_from(start, op.size(), valves, op, mv);
  stand_before(start, mv);
}

void run_from_every_turn(std::vector<Valve> valves, std::span<const double> op,
                         std::span<const OpTurn> turns, std::span<EightNumbers> mv) {
  if (turns.empty()) return run_from_first_turn(std::move(valves), op, turns, mv);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::size_t end = i + 1 < turns.size() ? turns[i + 1].sample : op.size();
    run_from(turns[i], end, valves, op, mv);
  }
  stand_before(turns.front(), mv);
}

}  // namespace loopscope::core::model
