#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/core/model/field_bases.hpp"
#include "tests/core/model/field_families.hpp"

namespace loopscope::tests::model {
namespace {

/// A loop whose valve sticks so that it cycles, at least six times in the record and with at least
/// six samples a cycle.
FieldSettings sticking(Loop base, Friction friction, std::size_t samples, Draw& draw) {
  for (;;) {
    FieldSettings s = base(draw);
    s.valve.friction = friction;
    s.valve.stickband_percent = draw.log_between(0.5, 10.0);
    s.valve.slip_jump_percent = s.valve.stickband_percent * draw.between(0.15, 1.0);
    s.valve.asymmetry = draw.chance(0.5) ? draw.between(-0.1, 0.1) : 0.0;
    s.load_step_std = 1e-3 * s.valve.stickband_percent;
    const FieldLoop quiet = run_field_loop(s, samples, draw);
    const double period = period_of(quiet.op);
    const double swing_op = std_of(quiet.op);
    const bool cycles = period > 6.0 && period < static_cast<double>(samples) / 6.0;
    if (!cycles || swing_op < 0.1 * s.valve.stickband_percent ||
        swing_op > 4.0 * s.valve.stickband_percent)
      continue;
    roughen(s, std_of(quiet.pv), 0.5 * s.valve.stickband_percent, draw);
    return s;
  }
}

/// Places where mv turns by more than `least`.
std::vector<std::size_t> turns(const std::vector<double>& mv, double least) {
  std::vector<std::size_t> places;
  double high = mv[0], low = mv[0];
  int direction = 0;
  for (std::size_t k = 1; k < mv.size(); ++k) {
    high = std::max(high, mv[k]);
    low = std::min(low, mv[k]);
    if ((direction >= 0 && high - mv[k] > least) || (direction <= 0 && mv[k] - low > least)) {
      direction = high - mv[k] > least ? -1 : 1;
      places.push_back(k);
      high = low = mv[k];
    }
  }
  return places;
}

/// The valve does cycle: six times at least and without a rest longer than a fifth of the record,
/// noise and load on top notwithstanding; an engineer could see it.
bool cycles_visibly(const FieldLoop& loop, const FieldSettings& s) {
  const std::vector<std::size_t> places = turns(loop.mv, 0.5 * s.valve.slip_jump_percent);
  const auto samples = static_cast<double>(loop.mv.size());
  if (places.size() < 12 || samples / static_cast<double>(places.size()) < 3.0) return false;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    longest = std::max(longest, places[i] - places[i - 1]);
  return static_cast<double>(longest) < 0.2 * samples && s.noise_std < 0.5 * std_of(loop.pv);
}

/// Settings changed at will by `change`, drawn again until the valve visibly cycles.
template <typename Change>
FieldLoop visible_stiction(Loop base, Friction friction, Draw& draw, Change change) {
  for (;;) {
    const std::size_t samples = record_length(draw);
    FieldSettings s = sticking(base, friction, samples, draw);
    change(s, samples);
    FieldLoop loop = run_field_loop(s, samples, draw);
    if (cycles_visibly(loop, s)) return loop;
  }
}

template <Loop base, Friction friction>
FieldLoop plain_stiction(Draw& draw) {
  return visible_stiction(base, friction, draw, [](FieldSettings&, std::size_t) {});
}

FieldLoop archived_stiction(Draw& draw) {
  const Friction friction = draw.chance(0.5) ? Friction::he : Friction::karnopp;
  return visible_stiction(any_loop, friction, draw, [&](FieldSettings& s, std::size_t samples) {
    const FieldLoop clear = run_field_loop(s, samples, draw);
    historian(s, std_of(clear.pv), std_of(clear.op), draw);
  });
}

FieldLoop moved_stiction(Draw& draw) {
  return visible_stiction(any_loop, Friction::he, draw, [&](FieldSettings& s, std::size_t samples) {
    s.setpoint_step_std = std_of(run_field_loop(s, samples, draw).pv) * draw.between(1.0, 4.0);
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
    wave.amplitude = std_of(clear.pv) * draw.between(0.2, 0.8);
    wave.phase_walk = 0.02;
    s.waves.push_back(wave);
  });
}

constexpr std::array kFamilies = {
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
  return kFamilies;
}

}  // namespace loopscope::tests::model
