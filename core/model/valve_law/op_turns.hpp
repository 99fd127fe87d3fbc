#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// A place where the controller output turns back.
struct OpTurn {
  std::size_t sample = 0;
  double op = 0.0;
  double direction = 1.0;  ///< of the motion that ends here: +1 (a maximum) or -1
};

/// Turns after which op goes back by more than `prominence` (op's unit), in order of time, maxima
/// and minima by turns. NaN is skipped.
[[nodiscard]] std::vector<OpTurn> find_op_turns(std::span<const double> op, double prominence);

/// run_valves by He's law (units and exceptions as there), the valves starting at the first turn,
/// where they have just moved, in whatever direction it ends. Before it they stand. `op` is not
/// empty.
void run_from_first_turn(std::vector<Valve> valves, std::span<const double> op,
                         std::span<const OpTurn> turns, std::span<EightNumbers> mv);

/// The same, started anew at every turn. In a self-regulating loop op turns because the valve has
/// slipped, so every turn tells where the valve is, and a slip that the law misses (the error has a
/// narrow minimum over S) is not carried on through the rest of the record.
void run_from_every_turn(std::vector<Valve> valves, std::span<const double> op,
                         std::span<const OpTurn> turns, std::span<EightNumbers> mv);

}  // namespace loopscope::core::model
