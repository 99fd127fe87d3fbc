#include <array>
#include <cmath>
#include <vector>

#include "tests/core/model/field_families.hpp"
#include "tests/core/model/visible_stiction.hpp"

namespace loopscope::tests::model {
namespace {

template <Loop base, Friction friction>
FieldLoop plain_stiction(Draw& draw) {
  return visible_stiction(base, friction, draw, [](FieldSettings&, std::size_t) {});
}

FieldLoop archived_stiction(Draw& draw) {
  const Friction friction = draw.chance(0.5) ? Friction::he : Friction::karnopp;
  return visible_stiction(any_loop, friction, draw, [&](FieldSettings& s, std::size_t samples) {
    const FieldLoop clear = run_field_loop(s, samples, draw);
    historian(s, standard_deviation(clear.pv), standard_deviation(clear.op), draw);
  });
}

FieldLoop moved_stiction(Draw& draw) {
  return visible_stiction(any_loop, Friction::he, draw, [&](FieldSettings& s, std::size_t samples) {
    s.setpoint_step_std =
        standard_deviation(run_field_loop(s, samples, draw).pv) * draw.between(1.0, 4.0);
    s.setpoint_every = static_cast<double>(samples * s.recording.every) / draw.between(3.0, 12.0);
  });
}

FieldLoop irregular_stiction(Draw& draw) {
  return visible_stiction(any_loop, Friction::karnopp, draw, [&](FieldSettings& s, std::size_t) {
    s.load_memory = draw.between(0.98, 0.995);
    s.load_step_std = (s.integrating ? 0.25 : 1.0) * s.valve.stickband_percent *
                      draw.between(0.1, 0.6) * std::sqrt(1.0 - s.load_memory * s.load_memory);
  });
}

FieldLoop disturbed_stiction(Draw& draw) {
  return visible_stiction(any_loop, Friction::he, draw, [&](FieldSettings& s, std::size_t samples) {
    const FieldLoop clear = run_field_loop(s, samples, draw);
    OutsideWave wave;
    wave.period_steps = period_of(clear.op) * static_cast<double>(s.recording.every) *
                        (draw.chance(0.5) ? draw.between(0.2, 0.6) : draw.between(1.8, 4.0));
    wave.amplitude = standard_deviation(clear.pv) * draw.between(0.2, 0.8);
    wave.phase_walk = 0.02;
    s.waves.push_back(wave);
  });
}

constexpr std::array kStickingFamilies = {
    FieldFamily{"stiction_flow_he", true, true, plain_stiction<flow, Friction::he>},
    FieldFamily{"stiction_flow_karnopp", true, false, plain_stiction<flow, Friction::karnopp>},
    FieldFamily{"stiction_level_he", true, false, plain_stiction<level, Friction::he>},
    FieldFamily{"stiction_level_karnopp", true, true, plain_stiction<level, Friction::karnopp>},
    FieldFamily{"stiction_temperature_he", true, true, plain_stiction<temperature, Friction::he>},
    FieldFamily{"stiction_temperature_karnopp", true, false,
                plain_stiction<temperature, Friction::karnopp>},
    FieldFamily{"stiction_archived", true, false, archived_stiction},
    FieldFamily{"stiction_setpoint_moves", true, true, moved_stiction},
    FieldFamily{"stiction_irregular", true, true, irregular_stiction},
    FieldFamily{"stiction_disturbed", true, false, disturbed_stiction},
};

}  // namespace

std::span<const FieldFamily> sticking_families() {
  return kStickingFamilies;
}

}  // namespace loopscope::tests::model
