#include "tests/core/model/visible_stiction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace loopscope::tests::model {
namespace {

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

}  // namespace

FieldSettings sticking(Loop base, Friction friction, std::size_t samples, Draw& draw) {
  return hunting(base, friction, {0.15, 1.0}, samples, draw);
}

FieldSettings hunting(Loop base, Friction friction, JumpShares jumps, std::size_t samples,
                      Draw& draw) {
  for (;;) {
    FieldSettings s = base(draw);
    s.valve.friction = friction;
    s.valve.stickband_percent = draw.log_between(0.5, 10.0);
    s.valve.slip_jump_percent = s.valve.stickband_percent * draw.between(jumps.least, jumps.most);
    s.valve.asymmetry = draw.chance(0.5) ? draw.between(-0.1, 0.1) : 0.0;
    s.load_step_std = 1e-3 * s.valve.stickband_percent;
    const FieldLoop quiet = run_field_loop(s, samples, draw);
    const double period = period_of(quiet.op);
    const double swing_op = standard_deviation(quiet.op);
    const bool cycles = period > 6.0 && period < static_cast<double>(samples) / 6.0;
    if (!cycles || swing_op < 0.1 * s.valve.stickband_percent ||
        swing_op > 4.0 * s.valve.stickband_percent)
      continue;
    roughen(s, standard_deviation(quiet.pv), 0.5 * s.valve.stickband_percent, draw);
    return s;
  }
}

bool cycles_visibly(const FieldLoop& loop, const FieldSettings& s) {
  const std::vector<std::size_t> places = turns(loop.mv, 0.5 * s.valve.slip_jump_percent);
  const auto samples = static_cast<double>(loop.mv.size());
  if (places.size() < 12 || samples / static_cast<double>(places.size()) < 3.0) return false;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    longest = std::max(longest, places[i] - places[i - 1]);
  return static_cast<double>(longest) < 0.2 * samples &&
         s.noise_std < 0.5 * standard_deviation(loop.pv);
}

FieldLoop visible_stiction(Loop base, Friction friction, Draw& draw, const Change& change,
                           Length length) {
  for (;;) {
    const std::size_t samples = length(draw);
    FieldSettings s = sticking(base, friction, samples, draw);
    change(s, samples);
    FieldLoop loop = run_field_loop(s, samples, draw);
    if (cycles_visibly(loop, s)) return loop;
  }
}

}  // namespace loopscope::tests::model
