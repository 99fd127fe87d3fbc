#include "tests/core/model/healthy_loops.hpp"

#include <cmath>
#include <vector>

namespace loopscope::tests::model {
namespace {

/// The settings with an archive set by what the loop does.
FieldLoop archived(FieldSettings s, std::size_t samples, Draw& draw) {
  const FieldLoop clear = run_field_loop(s, samples, draw);
  historian(s, standard_deviation(clear.pv), standard_deviation(clear.op), draw);
  return run_field_loop(s, samples, draw);
}

bool runs_away(FieldSettings s, double factor, Draw& draw) {
  s.controller_gain *= factor;
  s.load_step_std = 1e-4;
  s.recording.every = 1;
  const FieldLoop loop = run_field_loop(s, 600, draw);
  const std::vector<double> early(loop.op.begin(), loop.op.begin() + 300);
  const std::vector<double> late(loop.op.begin() + 300, loop.op.end());
  return standard_deviation(loop.op) > 0.5 ||
         standard_deviation(late) > 3.0 * standard_deviation(early);
}

}  // namespace

OutsideWave outside(OutsideWave::Shape shape, bool at_input, Draw& draw) {
  OutsideWave wave;
  wave.shape = shape;
  wave.period_steps = draw.log_between(12.0, 150.0);
  wave.amplitude = 1.0;
  wave.phase_walk = draw.chance(0.5) ? draw.between(0.0, 0.04) : draw.between(0.04, 0.15);
  wave.fading = draw.chance(0.5) ? draw.between(0.0, 0.5) : 0.0;
  wave.at_input = at_input;
  return wave;
}

FieldLoop waved(FieldSettings s, Draw& draw, bool archive_too, Length length) {
  const std::size_t samples = length(draw);
  const FieldLoop clear = run_field_loop(s, samples, draw);
  const double swing_pv = standard_deviation(clear.pv), swing_op = standard_deviation(clear.op);
  roughen(s, swing_pv, swing_op, draw);
  if (draw.chance(0.5)) {
    s.valve.friction = Friction::he;
    s.valve.stickband_percent = 0.1 * swing_op * draw.between(0.0, 1.0);
    s.valve.slip_jump_percent = 0.5 * s.valve.stickband_percent;
  }
  return archive_too ? archived(s, samples, draw) : run_field_loop(s, samples, draw);
}

FieldSettings tightened(FieldSettings s, double share, Draw& draw) {
  double low = 0.3, high = 100.0;
  for (int i = 0; i < 12; ++i) {
    const double middle = std::sqrt(low * high);
    (runs_away(s, middle, draw) ? high : low) = middle;
  }
  s.controller_gain *= share * low;
  return s;
}

}  // namespace loopscope::tests::model
