#include <array>
#include <cmath>
#include <vector>

#include "tests/core/model/field_families.hpp"
#include "tests/core/model/healthy_loops.hpp"
#include "tests/core/model/plant_bases.hpp"
#include "tests/core/model/visible_stiction.hpp"

namespace loopscope::tests::model {
namespace {

using Shape = OutsideWave::Shape;

/// A healthy loop that a sticking one disturbs: what reaches it has passed a lag.
FieldLoop victim(Draw& draw) {
  FieldSettings source = sticking(any_loop, either(draw), 1000, draw);
  source.recording.every = 1;
  source.noise_std = 0.0;
  FieldSettings s = any_loop(draw);
  s.neighbour = run_field_loop(source, 4000, draw).pv;
  const double swing = standard_deviation(s.neighbour);
  const double keep = std::exp(-1.0 / draw.log_between(0.3, 10.0));
  double lagged = s.neighbour.front();
  for (double& value : s.neighbour) {
    lagged += (1.0 - keep) * (value - lagged);
    value = (lagged - 100.0) / swing;
  }
  return waved(s, draw);
}

FieldLoop slow_wave(Draw& draw) {
  FieldSettings s = slow(draw);
  s.waves.push_back(outside(Shape::sine, s.integrating, draw));
  s.waves.back().period_steps = draw.between(60.0, 120.0);
  return waved(s, draw, false, short_record);
}

FieldLoop concentration_wave(Draw& draw) {
  FieldSettings s = concentration(draw);
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, true, draw));
  s.waves.back().period_steps *= 2.0;
  return waved(s, draw);
}

FieldLoop tight_concentration(Draw& draw) {
  FieldSettings s = tightened(concentration(draw), draw.between(0.75, 0.97), draw);
  s.load_step_std = 0.2;
  s.load_memory = 0.99;
  return waved(s, draw);
}

FieldLoop proportional_level(Draw& draw) {
  FieldSettings s = level(draw);
  s.integral_steps = 1e9;
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::square, true, draw));
  return waved(s, draw);
}

FieldLoop coarse_wave(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.waves.push_back(outside(Shape::sine, s.integrating, draw));
  const FieldLoop clear = run_field_loop(s, 1000, draw);
  s.recording.pv_grid = standard_deviation(clear.pv) * draw.between(0.2, 0.8);
  s.recording.archive_grid_op = standard_deviation(clear.op) * draw.between(0.1, 0.5);
  return waved(s, draw);
}

FieldLoop one_sided_limit(Draw& draw) {
  FieldSettings s = tightened(any_loop(draw), draw.between(1.05, 1.5), draw);
  const double reach = draw.log_between(3.0, 40.0);
  s.op_low = 50.0 - reach;
  s.op_high = 50.0 + reach * draw.between(1.5, 6.0);
  s.load_step_std = 0.05;
  return waved(s, draw);
}

FieldLoop bursts(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.waves.push_back(outside(Shape::sine, s.integrating, draw));
  s.waves.back().fading = draw.between(0.8, 1.5);
  s.waves.back().phase_walk = draw.between(0.02, 0.1);
  return waved(s, draw);
}

FieldLoop long_wave(Draw& draw) {
  FieldSettings s = any_loop(draw);
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, s.integrating, draw));
  s.waves.back().period_steps *= 3.0;
  return waved(s, draw, false, long_record);
}

FieldLoop complicated_wave(Draw& draw) {
  FieldSettings s = complicated<any_loop>(draw);
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, s.integrating, draw));
  return waved(s, draw);
}

FieldLoop complicated_tight(Draw& draw) {
  FieldSettings s = tightened(complicated<any_loop>(draw), draw.between(0.75, 0.97), draw);
  s.load_step_std = s.integrating ? 0.05 : 0.2;
  s.load_memory = 0.99;
  return waved(s, draw);
}

/// Play, a fifth to all of op's standard deviation: no limit cycle in a self-regulating loop.
FieldLoop with_play(FieldSettings s, Draw& draw) {
  const std::size_t samples = record_length(draw);
  const FieldLoop clear = run_field_loop(s, samples, draw);
  roughen(s, standard_deviation(clear.pv), standard_deviation(clear.op), draw);
  s.valve.friction = Friction::he;
  s.valve.stickband_percent = standard_deviation(clear.op) * draw.between(0.2, 1.0);
  s.valve.slip_jump_percent = 0.0;
  return run_field_loop(s, samples, draw);
}

FieldSettings self_regulating(Draw& draw) {
  return draw.chance(0.6) ? flow(draw) : temperature(draw);
}

FieldLoop play_and_wave(Draw& draw) {
  FieldSettings s = self_regulating(draw);
  s.waves.push_back(outside(draw.chance(0.5) ? Shape::sine : Shape::triangle, true, draw));
  return with_play(s, draw);
}

FieldLoop play_and_load(Draw& draw) {
  FieldSettings s = self_regulating(draw);
  s.load_memory = draw.between(0.9, 0.999);
  s.load_step_std = 0.3;
  return with_play(s, draw);
}

FieldLoop play_and_moves(Draw& draw) {
  FieldSettings s = self_regulating(draw);
  s.setpoint_step_std = draw.between(1.0, 5.0);
  s.setpoint_every = draw.log_between(50.0, 500.0);
  s.load_step_std = 0.1;
  return with_play(s, draw);
}

constexpr std::array kPlantHealthyFamilies = {
    FieldFamily{"victim_of_stiction", false, false, victim},
    FieldFamily{"slow_wave", false, true, slow_wave},
    FieldFamily{"concentration_wave", false, true, concentration_wave},
    FieldFamily{"tight_concentration", false, false, tight_concentration},
    FieldFamily{"proportional_level", false, true, proportional_level},
    FieldFamily{"coarse_wave", false, true, coarse_wave},
    FieldFamily{"one_sided_limit", false, false, one_sided_limit},
    FieldFamily{"bursts", false, false, bursts},
    FieldFamily{"long_wave", false, false, long_wave},
    FieldFamily{"complicated_wave", false, false, complicated_wave},
    FieldFamily{"complicated_tight", false, true, complicated_tight},
    FieldFamily{"play_and_wave", false, false, play_and_wave},
    FieldFamily{"play_and_load", false, true, play_and_load},
    FieldFamily{"play_and_moves", false, false, play_and_moves},
};

}  // namespace

std::span<const FieldFamily> plant_healthy_families() {
  return kPlantHealthyFamilies;
}

}  // namespace loopscope::tests::model
