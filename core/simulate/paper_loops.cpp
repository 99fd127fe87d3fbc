#include "core/simulate/paper_loops.hpp"

namespace loopscope::core::simulate {

LoopSettings well_tuned_loop() {
  return {};
}

LoopSettings printed_integral_loop() {
  LoopSettings loop;
  loop.controller.integral = 0.15 / 2.5;
  return loop;
}

LoopSettings excessive_integral_loop() {
  LoopSettings loop;
  loop.controller.integral = 0.15 * 2.5;
  return loop;
}

LoopSettings outside_sinusoid_loop() {
  LoopSettings loop;
  loop.effects = {
      ExternalOscillation{.period_s = 100.0 * loop.sample_interval_s, .amplitude = 2.0}};
  return loop;
}

LoopSettings sticking_loop(StictionLaw law) {
  LoopSettings loop;
  loop.effects = {ValveStiction{.stickband_percent = 3.0, .slip_jump_percent = 1.0, .law = law}};
  loop.setpoint_moves = {{.at_sample = 100, .size = 10.0}};
  return loop;
}

}  // namespace loopscope::core::simulate
