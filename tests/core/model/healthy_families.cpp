#include <array>

#include "tests/core/model/field_families.hpp"
#include "tests/core/model/healthy_loops.hpp"

namespace loopscope::tests::model {
namespace {

using Shape = OutsideWave::Shape;

template <Loop base, Shape shape, bool at_input>
FieldLoop outside_wave(Draw& draw) {
  FieldSettings s = base(draw);
  s.waves.push_back(outside(shape, at_input, draw));
  return waved(s, draw);
}

FieldLoop archived_wave(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, s.integrating, draw));
  return waved(s, draw, true);
}

FieldLoop several_waves(Draw& draw) {
  FieldSettings s = any_loop(draw);
  for (int i = 0; i < 3; ++i) {
    s.waves.push_back(outside(Shape::sine, s.integrating, draw));
    s.waves.back().amplitude = draw.between(0.3, 1.0);
  }
  return waved(s, draw);
}

template <Loop base>
FieldLoop tight(Draw& draw) {
  FieldSettings s = tightened(base(draw), draw.between(0.75, 0.97), draw);
  s.load_step_std = s.integrating ? 0.05 : 0.2;
  s.load_memory = 0.99;
  return waved(s, draw);
}

FieldLoop saturated(Draw& draw) {
  FieldSettings s = tightened(any_loop(draw), draw.between(1.05, 1.5), draw);
  const double reach = draw.log_between(3.0, 40.0);
  s.op_low = 50.0 - reach * draw.between(0.3, 1.0);
  s.op_high = 50.0 + reach;
  s.load_step_std = 0.05;
  return waved(s, draw);
}

FieldLoop analyser(Draw& draw) {
  FieldSettings s = temperature(draw);
  s.recording.sensor_hold = draw.whole(2, 10);
  s = tightened(s, draw.between(0.7, 0.98), draw);
  s.load_step_std = 0.2;
  s.load_memory = 0.99;
  const double swing = standard_deviation(run_field_loop(s, 1000, draw).pv);
  s.recording.sensor_dead_zone = swing * draw.between(0.1, 0.6);
  return waved(s, draw);
}

FieldLoop quantised(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.load_step_std = s.integrating ? 0.05 : 0.3;
  s.load_memory = draw.between(0.98, 0.999);
  const double swing = standard_deviation(run_field_loop(s, 1000, draw).pv);
  s.recording.pv_grid = swing * draw.between(0.2, 1.5);
  return waved(s, draw);
}

FieldLoop faulty_sensor(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.load_step_std = s.integrating ? 0.02 : 0.1;
  const double swing = standard_deviation(run_field_loop(s, 1000, draw).pv);
  s.recording.sensor_wander = swing * draw.between(0.5, 3.0);
  s.recording.spike_rate = draw.chance(0.5) ? draw.log_between(0.002, 0.03) : 0.0;
  s.recording.sensor_hold = draw.chance(0.5) ? draw.whole(2, 20) : 1;
  return waved(s, draw);
}

template <Loop base>
FieldLoop wandering(Draw& draw) {
  FieldSettings s = base(draw);
  s.load_memory = draw.between(0.9, 0.999);
  s.load_step_std = s.integrating ? 0.05 : 0.3;
  const std::size_t samples = record_length(draw);
  const double swing = standard_deviation(run_field_loop(s, samples, draw).pv);
  s.noise_std = swing * draw.log_between(0.05, 3.0);
  return run_field_loop(s, samples, draw);
}

FieldLoop cascade(Draw& draw) {
  FieldSettings s = flow(draw);
  s.master_walk = draw.between(0.0, 1.0);
  s.master = outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, false, draw);
  s.master.amplitude = draw.chance(0.7) ? 1.0 : 0.0;
  s.load_step_std = 0.05;
  return waved(s, draw);
}

FieldLoop setpoint_steps(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.setpoint_step_std = draw.between(1.0, 5.0);
  s.setpoint_every = draw.log_between(100.0, 1000.0);
  s.load_step_std = s.integrating ? 0.02 : 0.1;
  return waved(s, draw);
}

FieldLoop sluggish(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.controller_gain *= draw.log_between(0.02, 0.2);
  s.waves.push_back(outside(Shape::sine, s.integrating, draw));
  return waved(s, draw);
}

constexpr std::array kHealthyFamilies = {
    FieldFamily{"sine_flow", false, true, outside_wave<flow, Shape::sine, false>},
    FieldFamily{"lopsided_flow", false, false, outside_wave<flow, Shape::lopsided, false>},
    FieldFamily{"triangle_temperature", false, true,
                outside_wave<temperature, Shape::triangle, true>},
    FieldFamily{"sine_temperature", false, false, outside_wave<temperature, Shape::sine, false>},
    FieldFamily{"square_flow", false, true, outside_wave<flow, Shape::square, true>},
    FieldFamily{"sine_level", false, false, outside_wave<level, Shape::sine, true>},
    FieldFamily{"square_level", false, true, outside_wave<level, Shape::square, true>},
    FieldFamily{"archived_wave", false, true, archived_wave},
    FieldFamily{"several_waves", false, false, several_waves},
    FieldFamily{"tight_flow", false, false, tight<flow>},
    FieldFamily{"tight_level", false, true, tight<level>},
    FieldFamily{"tight_temperature", false, false, tight<temperature>},
    FieldFamily{"saturated", false, true, saturated},
    FieldFamily{"analyser_dead_zone", false, false, analyser},
    FieldFamily{"quantised", false, true, quantised},
    FieldFamily{"faulty_sensor", false, false, faulty_sensor},
    FieldFamily{"wandering_flow", false, true, wandering<flow>},
    FieldFamily{"wandering_level", false, false, wandering<level>},
    FieldFamily{"cascade_slave", false, true, cascade},
    FieldFamily{"setpoint_steps", false, false, setpoint_steps},
    FieldFamily{"sluggish_sine", false, true, sluggish},
};

}  // namespace

std::span<const FieldFamily> healthy_families() {
  return kHealthyFamilies;
}

}  // namespace loopscope::tests::model
