#include "tests/core/model/field_bases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/generators/simc.hpp"

namespace loopscope::tests::model {

std::size_t record_length(Draw& draw) {
  return static_cast<std::size_t>(draw.log_between(700.0, 4000.0));
}

/// Mean period in samples by crossings of the mean with a quarter of the spread as hysteresis.
double period_of(const std::vector<double>& x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  const double gate = 0.25 * standard_deviation(x);
  int side = 0;
  double ups = 0.0;
  for (const double v : x) {
    if (v > mean + gate && side <= 0) {
      ups += side < 0 ? 1.0 : 0.0;
      side = 1;
    }
    if (v < mean - gate) side = -1;
  }
  return static_cast<double>(x.size()) / std::max(ups, 0.5);
}

FieldSettings flow(Draw& draw) {
  FieldSettings s;
  const double sign = draw.chance(0.3) ? -1.0 : 1.0;
  s.gain = sign * draw.log_between(0.3, 5.0);
  s.lag_steps = draw.log_between(0.4, 5.0);
  s.dead_steps = draw.whole(1, 2);
  s.controller_gain = draw.log_between(0.1, 0.7) / s.gain;
  s.integral_steps = draw.log_between(2.0, 20.0);
  s.recording.every = draw.whole(1, 4);
  return s;
}

FieldSettings level(Draw& draw) {
  FieldSettings s;
  s.integrating = true;
  const double closed = draw.log_between(6.0, 60.0);
  s.gain = (draw.chance(0.4) ? -1.0 : 1.0) * draw.log_between(0.002, 0.1);
  s.dead_steps = draw.whole(1, 3);
  s.second_lag_steps = draw.chance(0.5) ? draw.between(0.0, 4.0) : 0.0;
  s.controller_gain = 1.0 / (s.gain * closed);
  s.integral_steps = closed * draw.between(2.0, 6.0);
  s.recording.every = draw.whole(1, 5);
  return s;
}

FieldSettings temperature(Draw& draw) {
  FieldSettings s;
  s.gain = (draw.chance(0.5) ? -1.0 : 1.0) * draw.log_between(0.2, 3.0);
  s.lag_steps = draw.log_between(10.0, 80.0);
  s.second_lag_steps = draw.between(0.0, 0.3) * s.lag_steps;
  s.dead_steps = draw.whole(2, 10);
  const double dead = static_cast<double>(s.dead_steps) + 0.5 * s.second_lag_steps;
  const double closed = dead * draw.between(0.8, 2.5);
  const auto [gain, integral_steps] = generators::simc_of_lag(s.gain, s.lag_steps, closed + dead);
  s.controller_gain = gain;
  s.integral_steps = integral_steps;
  s.recording.every = draw.whole(1, 5);
  return s;
}

FieldSettings any_loop(Draw& draw) {
  const double which = draw.between(0.0, 1.0);
  return which < 0.5 ? flow(draw) : which < 0.8 ? level(draw) : temperature(draw);
}

/// Noise and a wandering load as shares of what the loop does without them.
void roughen(FieldSettings& s, double swing_pv, double swing_op, Draw& draw) {
  s.noise_std = swing_pv * draw.log_between(0.03, 0.5);
  s.load_memory = 1.0 - draw.log_between(0.001, 0.03);
  const double load = s.integrating ? 0.25 : 1.0;
  s.load_step_std = load * swing_op * draw.log_between(0.004, 0.4) *
                    std::sqrt(1.0 - s.load_memory * s.load_memory);
}

void historian(FieldSettings& s, double swing_pv, double swing_op, Draw& draw) {
  Recording& r = s.recording;
  if (draw.chance(0.5)) r.archive_grid_pv = swing_pv * draw.between(0.05, 0.5);
  if (draw.chance(0.5)) r.archive_grid_op = swing_op * draw.between(0.05, 0.3);
  if (draw.chance(0.5)) r.archive_band_pv = swing_pv * draw.between(0.1, 0.6);
  if (draw.chance(0.3)) r.archive_band_op = swing_op * draw.between(0.05, 0.3);
  r.interpolate = draw.chance(0.5);
}

}  // namespace loopscope::tests::model
