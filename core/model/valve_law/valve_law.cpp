#include "core/model/valve_law/valve_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "core/model/valve_law/valve_between_samples.hpp"
#include "core/model/valve_law/valve_kernel.hpp"
#include "core/model/valve_law/valve_lanes-inl.hpp"

namespace loopscope::core::model {
namespace {

void check(const Valve& valve, std::size_t ops, std::size_t positions) {
  const bool jump_in_band =
      valve.slip_jump_percent >= 0.0 && valve.slip_jump_percent <= valve.stickband_percent;
  if (!jump_in_band || ops != positions) {
    throw std::invalid_argument("run_valve: 0 <= J <= S or the lengths do not hold");
  }
}

template <ValveLaw law>
void follow(Friction friction, OpMotion<double> motion, ValveLanes<double, 1> valve,
            std::span<const double> op, std::span<double> mv) {
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (!std::isnan(op[k])) valve.step<law>(friction, motion.take(op[k]));
    mv[k] = valve.position[0];
  }
}

}  // namespace

std::string_view name(ValveLaw law) {
  switch (law) {
    case ValveLaw::choudhury:
      return "choudhury";
    case ValveLaw::kano:
      return "kano";
    case ValveLaw::he:
      return "he";
  }
  return "";
}

void run_valve(const Valve& valve, std::span<const double> op, std::span<double> mv) {
  check(valve, op.size(), mv.size());
  const auto first = std::ranges::find_if(op, [](double value) { return !std::isnan(value); });
  if (first == op.end()) {
    std::ranges::fill(mv, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (valve.acts_at_samples()) {
    const Friction friction(valve);
    ValveLanes<double, 1> lane;
    lane.start(friction, valve.start_direction, *first);
    if (valve.start_percent) lane.position[0] = *valve.start_percent;
    const OpMotion<double> motion{*first, valve.start_direction};
    with_law(valve.law, [&]<ValveLaw law>() { follow<law>(friction, motion, lane, op, mv); });
  } else {
    run_between_samples(valve, *first, op, mv);
  }
  const auto missing = static_cast<std::size_t>(first - op.begin());
  std::ranges::fill(mv.first(missing), std::numeric_limits<double>::quiet_NaN());
}

void run_valves(std::span<const Valve> valves, std::span<const double> op,
                std::span<EightNumbers> mv) {
  for (const Valve& valve : valves) check(valve, op.size(), mv.size());
  const auto first = std::ranges::find_if(op, [](double value) { return !std::isnan(value); });
  const auto missing = static_cast<std::size_t>(first - op.begin());
  for (EightNumbers& row : mv.first(missing))
    std::ranges::fill(row.numbers, std::numeric_limits<double>::quiet_NaN());
  if (first == op.end()) return;
  follow_valves(valves, op.subspan(missing), mv.subspan(missing));
}

}  // namespace loopscope::core::model
