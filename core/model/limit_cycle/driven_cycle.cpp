#include "core/model/limit_cycle/driven_cycle.hpp"

#include "core/model/limit_cycle/op_turns.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kRestingSetpoint = 0.1;
/// Between one, where op follows the setpoint, and two.
constexpr double kFaster = 1.5;

}  // namespace

bool setpoint_moves(const ModelInput& input) {
  const auto sp = signal::measure_spread(input.sp);
  const auto pv = signal::measure_spread(input.pv);
  return sp && pv && sp->std > kRestingSetpoint * pv->std;
}

bool driven_by_setpoint(const ModelInput& input, const CycleEvidence& cycle) {
  if (!setpoint_moves(input)) return false;
  const double sp_std = signal::measure_spread(input.sp)->std;
  const double cycles = 0.5 * static_cast<double>(find_op_turns(input.sp, sp_std).size());
  return cycle.cycles <= kFaster * cycles;
}

}  // namespace loopscope::core::model
