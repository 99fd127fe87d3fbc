#include "tests/verdict/mixed_loop.hpp"

#include <algorithm>
#include <cmath>

#include "tests/core/model/healthy_loops.hpp"
#include "tests/core/model/plant_bases.hpp"
#include "tests/core/model/visible_stiction.hpp"
#include "tests/verdict/field_draft.hpp"

namespace loopscope::tests::verdict {
namespace {

using Code = core::diagnosis::VerdictCode;
using model::Draw;
using model::FieldLoop;
using model::FieldSettings;
using model::OutsideWave;
using model::standard_deviation;

constexpr double kLeastSamples = 512.0, kMostSamples = 4096.0;
constexpr std::size_t kMixedSwingSamples = 1000;

FieldSettings any_base(Draw& draw) {
  const double which = draw.between(0.0, 1.0);
  FieldSettings s = which < 0.35   ? model::flow(draw)
                    : which < 0.55 ? model::level(draw)
                    : which < 0.8  ? model::temperature(draw)
                                   : model::concentration(draw);
  if (draw.chance(0.2)) model::complicate(s, draw);
  s.trim = 0.0;
  return s;
}

std::size_t any_length(Draw& draw) {
  return draw.chance(0.35)
             ? static_cast<std::size_t>(kMostSamples)
             : static_cast<std::size_t>(draw.log_between(kLeastSamples, kMostSamples));
}

/// A record of three to nine cycles, where the loop is slow enough for one.
void few_cycles(FieldDraft& m, double period_samples, Draw& draw) {
  const double length = period_samples * draw.between(3.0, 9.0);
  if (length > kLeastSamples) m.samples = static_cast<std::size_t>(std::min(length, kMostSamples));
}

/// A level, or a temperature whose integral action outruns its lag: such loops cycle about play.
FieldSettings outrunning(Draw& draw) {
  const bool vessel = draw.chance(0.5);
  FieldSettings s = vessel ? model::level(draw) : model::temperature(draw);
  s.integral_steps *= vessel ? draw.log_between(0.4, 3.0) : draw.log_between(0.15, 0.7);
  if (draw.chance(0.2)) model::complicate(s, draw);
  return s;
}

/// A load that wanders: by so many standard deviations of op, or of 1 %.
void wander(FieldSettings& s, double scale, double least, double most, Draw& draw) {
  s.load_memory = 1.0 - draw.log_between(0.0005, 0.05);
  s.load_step_std = (s.integrating ? 0.25 : 1.0) * scale * draw.log_between(least, most) *
                    std::sqrt(1.0 - s.load_memory * s.load_memory);
}

/// Packing is not even, and a load that wanders as far as the cycle goes makes cycles uneven.
void make_uneven(FieldDraft& m, double swing_op, Draw& draw) {
  FieldSettings& s = m.settings;
  if (draw.chance(0.5)) s.valve.asymmetry = draw.between(-0.4, 0.4);
  if (draw.chance(0.4)) wander(s, swing_op, 0.1, 1.0, draw);
}

/// A loop that cycles about the band of its valve. Where it is fast, fewer samples are left of it:
/// a few cycles need a slow one.
void hunts(FieldDraft& m, bool sticks, Draw& draw) {
  const bool few = draw.chance(0.3);
  const auto base = !sticks ? outrunning : few ? model::slow : any_base;
  const model::JumpShares jumps =
      sticks ? model::JumpShares{0.15, 1.0} : model::JumpShares{0.0, 0.0};
  const model::Friction law = sticks ? model::either(draw) : model::Friction::he;
  const auto most = static_cast<std::size_t>(kMostSamples);
  m.settings = model::hunting(base, law, jumps, most, draw);
  m.settings.trim = 0.0;
  m.truth.causes.insert(sticks ? Code::valve_stiction : Code::valve_deadband);
  const FieldLoop clear = run_field_loop(m.settings, most, draw);
  if (few) few_cycles(m, model::period_of(clear.op), draw);
  make_uneven(m, standard_deviation(clear.op), draw);
}

/// Something to travel for: a load that wanders, and often a setpoint that moves.
void stir(FieldDraft& m, Draw& draw) {
  FieldSettings& s = m.settings;
  wander(s, 1.0, 0.3, 6.0, draw);
  if (draw.chance(0.3)) {
    s.setpoint_step_std =
        std::abs(s.integrating ? 20.0 * s.gain : s.gain) * draw.log_between(1.0, 15.0);
    s.setpoint_every = draw.log_between(40.0, 1000.0);
  }
}

OutsideWave any_wave(const FieldDraft& m, Draw& draw) {
  const auto shape = static_cast<OutsideWave::Shape>(draw.whole(0, 3));
  const bool plain = draw.chance(0.5);
  OutsideWave wave = model::outside(plain ? OutsideWave::Shape::sine : shape,
                                    m.settings.integrating || draw.chance(0.4), draw);
  const auto steps = static_cast<double>(m.samples * m.settings.recording.every);
  if (draw.chance(0.2)) wave.period_steps = steps / draw.between(3.0, 9.0);
  wave.amplitude = (wave.at_input ? m.swing_op : m.swing_pv) * draw.log_between(0.3, 3.0);
  return wave;
}

void add_wave(FieldDraft& m, Draw& draw) {
  m.settings.waves.push_back(any_wave(m, draw));
  m.truth.causes.insert(Code::external_disturbance);
}

void add_friction(FieldDraft& m, double jump_share, Draw& draw) {
  model::FieldValve& valve = m.settings.valve;
  valve.friction = jump_share > 0.0 ? model::either(draw) : model::Friction::he;
  valve.stickband_percent = m.swing_op * draw.log_between(0.3, 4.0);
  valve.slip_jump_percent = jump_share * valve.stickband_percent;
  m.truth.causes.insert(jump_share > 0.0 ? Code::valve_stiction : Code::valve_deadband);
}

void add_limit(FieldDraft& m, Draw& draw) {
  const double reach = m.swing_op * draw.between(0.5, 2.0);
  const bool above = draw.chance(0.5);
  if (above || draw.chance(0.3)) m.settings.op_high = std::min(100.0, 50.0 + reach);
  if (!above) m.settings.op_low = std::max(0.0, 50.0 - reach);
  m.truth.causes.insert(Code::valve_saturation);
}

void add_trim(FieldDraft& m, Draw& draw) {
  m.settings.trim = (draw.chance(0.5) ? 1.0 : -1.0) * draw.log_between(0.3, 3.0);
  // By how much the gain changes over op's travel.
  const double bend = std::abs(m.settings.trim) * 4.0 * m.swing_op / 50.0;
  if (bend > 0.3)
    m.truth.causes.insert(Code::valve_characteristic);
  else if (bend > 0.05)
    m.truth.doubtful.insert(Code::valve_characteristic);
}

void add_coarse_sensor(FieldDraft& m, Draw& draw) {
  m.settings.recording.pv_grid = m.swing_pv * draw.log_between(0.1, 2.0);
}

void judge_grid(double grid, SimulatedLoop& loop) {
  if (grid > kCoarse * standard_deviation(loop.pv)) loop.truth.causes.insert(Code::sensor_fault);
}

void add_hold(FieldDraft& m, Draw& draw) {
  m.settings.recording.sensor_hold = m.settings.recording.every * draw.whole(2, 12);
  m.truth.causes.insert(Code::sensor_fault);
}

/// What is no fault: how the controller works and how the transmitter filters.
void add_habits(FieldDraft& m, Draw& draw) {
  FieldSettings& s = m.settings;
  if (draw.chance(0.4)) s.recording.means = true;
  if (draw.chance(0.2)) s.controller_every = draw.whole(2, 4) * (s.integrating ? 2 : 1);
  if (draw.chance(0.15)) s.op_step = m.swing_op * draw.log_between(0.02, 1.0);
  if (draw.chance(0.15)) {
    s.master = any_wave(m, draw);
    s.master.amplitude = m.swing_pv * draw.log_between(0.3, 2.0);
    s.master_walk = m.swing_pv * draw.between(0.0, 0.5);
    m.truth.doubtful.insert(Code::external_disturbance);
  }
}

void tune(FieldDraft& m, Draw& draw) {
  if (draw.chance(0.4)) {
    m.settings = model::tightened(m.settings, draw.between(0.72, 0.98), draw);
    m.truth.causes.insert(Code::tight_tuning);
    return;
  }
  m.settings.controller_gain *= draw.log_between(0.02, 0.2);
  (m.settings.integrating ? m.truth.doubtful : m.truth.causes).insert(Code::sluggish_tuning);
}

/// A transmitter's range by which the process has this static gain, % by %.
void size_valve(const FieldDraft& m, SimulatedLoop& loop, Draw& draw) {
  if (m.settings.integrating || draw.chance(0.6)) return;
  const bool large = draw.chance(0.25);
  const double gain = large ? draw.log_between(5.0, 40.0) : draw.log_between(0.4, 2.5);
  loop.pv_span = 100.0 * std::abs(m.settings.gain) / gain;
  if (large) loop.truth.causes.insert(Code::valve_oversized);
}

FieldDraft make(Draw& draw) {
  FieldDraft m;
  m.samples = any_length(draw);
  const double story = draw.between(0.0, 1.0);
  const bool cycles = story < 0.26;
  if (cycles) {
    hunts(m, story < 0.17, draw);
    measure_swing(m, kMixedSwingSamples, draw);
  } else {
    m.settings = any_base(draw);
    stir(m, draw);
    if (story > 0.86) tune(m, draw);
    measure_swing(m, kMixedSwingSamples, draw);
    if (story < 0.46) add_friction(m, story < 0.31 ? draw.between(0.1, 1.0) : 0.0, draw);
  }
  const bool quiet = m.truth.causes.empty();
  if (draw.chance(quiet ? 0.3 : 0.15)) add_wave(m, draw);
  if (draw.chance(0.06)) add_limit(m, draw);
  if (draw.chance(cycles ? 0.3 : 0.1)) add_trim(m, draw);
  if (draw.chance(0.06)) add_coarse_sensor(m, draw);
  if (draw.chance(0.05)) add_hold(m, draw);
  if (draw.chance(0.4)) m.settings.valve.spread = draw.log_between(0.03, 0.3);
  add_habits(m, draw);
  const double noise = draw.log_between(0.02, 0.7);
  m.settings.noise_std = m.swing_pv * noise;
  if (draw.chance(0.3))
    m.settings.noise = draw.chance(0.5) ? model::NoiseKind::t5 : model::NoiseKind::bursts;
  return m;
}

}  // namespace

SimulatedLoop mixed_loop(std::uint64_t seed) {
  Draw draw(seed);
  const FieldDraft m = make(draw);
  SimulatedLoop loop = run_draft(m, "mixed", draw);
  judge_grid(m.settings.recording.pv_grid, loop);
  size_valve(m, loop, draw);
  return loop;
}

}  // namespace loopscope::tests::verdict
