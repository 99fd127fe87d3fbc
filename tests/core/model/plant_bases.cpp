#include "tests/core/model/plant_bases.hpp"

#include <algorithm>

#include "tests/generators/simc.hpp"

namespace loopscope::tests::model {

Friction either(Draw& draw) {
  return draw.chance(0.5) ? Friction::he : Friction::karnopp;
}

std::size_t short_record(Draw& draw) {
  return static_cast<std::size_t>(draw.log_between(700.0, 1500.0));
}

std::size_t long_record(Draw& draw) {
  return static_cast<std::size_t>(draw.log_between(6000.0, 18000.0));
}

FieldSettings slow(Draw& draw) {
  FieldSettings s = draw.chance(0.5) ? temperature(draw) : level(draw);
  s.recording.every = 1;
  return s;
}

FieldSettings concentration(Draw& draw) {
  FieldSettings s;
  s.gain = (draw.chance(0.5) ? -1.0 : 1.0) * draw.log_between(0.2, 3.0);
  s.lag_steps = draw.log_between(3.0, 30.0);
  s.dead_steps = draw.whole(5, 30);
  const auto dead = static_cast<double>(s.dead_steps);
  const double closed = dead * draw.between(0.8, 2.5);
  s.controller_gain = generators::simc_of_lag(s.gain, s.lag_steps, closed + dead).gain;
  s.integral_steps = s.lag_steps;
  s.recording.every = draw.whole(1, 4);
  return s;
}

void complicate(FieldSettings& s, Draw& draw) {
  const double slowest = s.integrating ? 10.0 : std::max(1.0, s.lag_steps);
  s.actuator_lag_steps = slowest * draw.between(0.0, 0.4);
  s.filter_steps = slowest * draw.between(0.0, 0.4);
  s.trim = draw.between(-2.0, 2.0);
  s.recording.pv_late = draw.chance(0.5);
}

}  // namespace loopscope::tests::model
