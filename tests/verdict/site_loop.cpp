#include "tests/verdict/site_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/core/model/healthy_loops.hpp"
#include "tests/core/model/plant_bases.hpp"
#include "tests/core/model/visible_stiction.hpp"
#include "tests/generators/simc.hpp"
#include "tests/verdict/field_draft.hpp"

namespace loopscope::tests::verdict {
namespace {

using Code = core::diagnosis::VerdictCode;
using model::Draw;
using model::FieldSettings;
using model::standard_deviation;

constexpr std::size_t kSiteSwingSamples = 2000;
constexpr double kTwelveBitGrid = 100.0 / 4096.0;  ///< of the span, %

struct Interval {
  double low = 0.0, high = 0.0;
  double draw(Draw& random) const { return random.log_between(low, high); }
};

/// What the loops of a kind have; times in steps.
struct Kind {
  double share = 0.0;
  Interval lag, dead, load_time;
  double second_share = 0.0;  ///< largest second lag by the first
  Interval noise;             ///< % of span
};

constexpr std::array kSelfRegulating = {
    Kind{0.30, {0.5, 8}, {1, 4}, {30, 1000}, 0.0, {0.04, 0.6}},     // flow
    Kind{0.25, {5, 60}, {1, 8}, {100, 1500}, 0.25, {0.02, 0.3}},    // pressure
    Kind{0.33, {20, 400}, {3, 60}, {300, 3000}, 0.4, {0.01, 0.2}},  // temperature
    Kind{0.12, {8, 150}, {10, 60}, {200, 3000}, 0.2, {0.02, 0.4}},  // concentration
};

struct SiteDraft : FieldDraft {
  double residence_steps = 0.0;  ///< lags and dead time; of a vessel the closed loop's time
};

double dead_time(const FieldSettings& s) {
  return static_cast<double>(s.dead_steps) + 0.5 + 0.5 * s.second_lag_steps;
}

/// A load that wanders, smoothed by what it passes before the process.
void load(FieldSettings& s, double size, double time, Draw& draw) {
  s.load_memory = std::exp(-1.0 / time);
  s.load_step_std = size * std::sqrt(1.0 - s.load_memory * s.load_memory);
  s.load_lag_steps = draw.chance(0.5) ? time * draw.log_between(0.03, 0.4) : 0.0;
}

/// SIMC with this time constant of the closed loop.
void tune_self_regulating(FieldSettings& s, double closed) {
  const double lag = s.lag_steps + 0.5 * s.second_lag_steps;
  const auto [gain, integral] = generators::simc_of_lag(s.gain, lag, closed + dead_time(s));
  s.controller_gain = gain;
  s.integral_steps = std::max(integral, 0.5);
}

void tune_vessel(FieldSettings& s, double closed) {
  s.controller_gain = 1.0 / (s.gain * (closed + dead_time(s)));
  s.integral_steps = 4.0 * (closed + dead_time(s));
}

SiteDraft self_regulating(Draw& draw) {
  double which = draw.between(0.0, 1.0);
  std::size_t k = 0;
  while (k + 1 < kSelfRegulating.size() && which > kSelfRegulating[k].share)
    which -= kSelfRegulating[k++].share;
  const Kind& kind = kSelfRegulating[k];
  SiteDraft m;
  FieldSettings& s = m.settings;
  s.gain = (draw.chance(0.35) ? -1.0 : 1.0) * draw.log_between(0.3, 2.5);
  s.lag_steps = kind.lag.draw(draw);
  s.second_lag_steps = draw.chance(0.6) ? s.lag_steps * kind.second_share * draw.between(0, 1) : 0;
  s.dead_steps = static_cast<std::size_t>(std::lround(kind.dead.draw(draw)));
  tune_self_regulating(s, dead_time(s) * draw.log_between(1.0, 5.0));
  s.noise_std = kind.noise.draw(draw);
  load(s, draw.log_between(0.2, 6.0), kind.load_time.draw(draw), draw);
  m.residence_steps = s.lag_steps + s.second_lag_steps + static_cast<double>(s.dead_steps);
  return m;
}

/// Tight levels and averaging ones.
SiteDraft vessel(Draw& draw) {
  SiteDraft m;
  FieldSettings& s = m.settings;
  s.integrating = true;
  s.gain = (draw.chance(0.4) ? -1.0 : 1.0) * draw.log_between(0.001, 0.03);
  s.dead_steps = draw.whole(1, 8);
  s.second_lag_steps = draw.chance(0.5) ? draw.between(0.0, 10.0) : 0.0;
  const double closed = dead_time(s) * draw.log_between(3.0, 60.0);
  tune_vessel(s, closed);
  s.noise_std = draw.log_between(0.02, 0.6);
  load(s, draw.log_between(0.2, 5.0), draw.log_between(100.0, 3000.0), draw);
  m.residence_steps = closed;
  return m;
}

void move_setpoint(FieldSettings& s, Draw& draw) {
  const double lot = draw.between(0.0, 1.0);
  if (lot < 0.3) {
    s.setpoint_every = draw.log_between(500.0, 12000.0);
    s.setpoint_step_std = draw.log_between(0.3, 4.0);
  } else if (lot < 0.4) {
    s.master_walk = draw.log_between(0.1, 1.0);
  }
}

/// Converters and displays: of them no fault comes by itself.
void round_signals(FieldSettings& s, Draw& draw) {
  const double pv = draw.between(0.0, 1.0);
  if (pv < 0.35)
    s.recording.pv_grid = kTwelveBitGrid;
  else if (pv < 0.45)
    s.recording.pv_grid = 0.1;
  const double op = draw.between(0.0, 1.0);
  if (op < 0.15)
    s.recording.archive_grid_op = 1.0;
  else if (op < 0.25)
    s.recording.archive_grid_op = draw.chance(0.5) ? 0.5 : 0.1;
  else if (op < 0.35)
    s.op_step = draw.chance(0.5) ? 0.1 : 0.025;
}

/// A valve's cycle is seen where the load does not hide it.
void stick(SiteDraft& m, bool sticks, Draw& draw) {
  FieldSettings& s = m.settings;
  s.load_step_std *= draw.log_between(0.1, 1.0);
  s.noise_std *= draw.log_between(0.3, 1.0);
  s.valve.friction = sticks ? model::either(draw) : model::Friction::he;
  s.valve.stickband_percent = draw.log_between(0.8, 6.0);
  s.valve.slip_jump_percent = sticks ? s.valve.stickband_percent * draw.between(0.15, 1.0) : 0.0;
  m.truth.causes.insert(sticks ? Code::valve_stiction : Code::valve_deadband);
}

/// Integral action by so many times of the process: three to five are a matter of taste.
void slow_down(SiteDraft& m, Draw& draw) {
  FieldSettings& s = m.settings;
  const double slowness = draw.log_between(3.0, 30.0);
  tune_self_regulating(s, slowness * m.residence_steps);
  s.integral_steps = s.lag_steps + 0.5 * s.second_lag_steps;
  s.load_step_std *= draw.log_between(1.0, 3.0);
  (slowness > 5.0 ? m.truth.causes : m.truth.doubtful).insert(Code::sluggish_tuning);
}

/// Slow loops swing longer than the search for their edge of stability looks.
constexpr double kLongestForTight = 60.0;

void tighten(SiteDraft& m, Draw& draw) {
  m.settings = model::tightened(m.settings, draw.between(0.75, 0.95), draw);
  m.truth.causes.insert(Code::tight_tuning);
}

void disturb(SiteDraft& m, Draw& draw) {
  model::OutsideWave wave = model::outside(model::OutsideWave::Shape::sine, true, draw);
  const double closed = std::max(4.0, m.residence_steps);
  wave.period_steps =
      std::min(closed * draw.log_between(1.0, 40.0), static_cast<double>(m.samples) / 3.0);
  wave.amplitude = std::max(1.0, m.swing_op) * draw.log_between(0.7, 5.0);
  if (wave.period_steps < 8.0) wave.period_steps = 8.0;
  m.settings.waves.push_back(wave);
  m.truth.causes.insert(Code::external_disturbance);
}

/// The load asks for more than the valve can give, for a tenth to most of the time.
void limit(SiteDraft& m, Draw& draw) {
  const double reach = m.swing_op * draw.between(-1.0, 1.3);
  if (draw.chance(0.5))
    m.settings.op_high = 50.0 + reach;
  else
    m.settings.op_low = 50.0 - reach;
  m.truth.causes.insert(Code::valve_saturation);
}

void break_something(SiteDraft& m, Draw& draw) {
  const double lot = draw.between(0.0, 1.0);
  const bool is_vessel = m.settings.integrating;
  if (lot < 0.40)
    stick(m, lot < 0.25, draw);
  else if (lot < 0.60 && !is_vessel)
    slow_down(m, draw);
  else if (lot < 0.72 && m.residence_steps < kLongestForTight)
    tighten(m, draw);
  else if (lot < 0.88)
    disturb(m, draw);
  else
    limit(m, draw);
}

/// A coarse grid, a load that once asks for more than the valve has: whether that is a fault the
/// plant has to say.
void doubt(const SiteDraft& m, const SimulatedLoop& loop, Truth& truth) {
  if (m.settings.recording.pv_grid > kCoarse * standard_deviation(loop.pv))
    truth.doubtful.insert(Code::sensor_fault);
  const auto ends = std::ranges::minmax(loop.op);
  if (ends.min <= 0.0 || ends.max >= 100.0) truth.doubtful.insert(Code::valve_saturation);
}

SiteDraft draft_site_loop(Draw& draw) {
  constexpr double kFaulty = 0.3;
  SiteDraft m = draw.chance(0.78) ? self_regulating(draw) : vessel(draw);
  if (draw.chance(0.5)) m.samples = static_cast<std::size_t>(draw.log_between(700.0, 4096.0));
  move_setpoint(m.settings, draw);
  round_signals(m.settings, draw);
  if (draw.chance(0.2)) m.settings.recording.every = draw.whole(2, 8);
  if (draw.chance(0.2)) m.settings.recording.means = m.settings.recording.every > 1;
  measure_swing(m, kSiteSwingSamples, draw);
  if (draw.chance(kFaulty)) break_something(m, draw);
  return m;
}

}  // namespace

SimulatedLoop site_loop(std::uint64_t seed) {
  Draw draw(seed);
  const SiteDraft m = draft_site_loop(draw);
  SimulatedLoop loop = run_draft(m, "site", draw);
  if (draw.chance(0.5)) loop.pv_span = 100.0;
  doubt(m, loop, loop.truth);
  return loop;
}

}  // namespace loopscope::tests::verdict
