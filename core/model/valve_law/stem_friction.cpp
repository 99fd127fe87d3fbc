#include "core/model/valve_law/stem_friction.hpp"

#include <cmath>

namespace loopscope::core::model {
namespace {

/// Of the band: so far the pressure turns back before a stem rests that no speed is too slow for.
/// One that has come up to it is told from one that is passed by in few digits too.
constexpr double kTurn = 1e-5;

/// What a first-order lag goes of its way in one look; all of it without a lag.
double share_of_way(double lag_samples) {
  return lag_samples > 0.0 ? 1.0 - std::exp(-1.0 / (kLooks * lag_samples)) : 1.0;
}

StemCourse<double> course_of(int looks, double pressure_share, double stem_share) {
  StemCourse<double> course{1.0, 0.0, 0.0, 0.0};
  double left = 1.0;  // of the pressure's way to op
  for (int i = 0; i < looks; ++i) {
    left *= 1.0 - pressure_share;
    course.own *= 1.0 - stem_share;
    course.pressure += stem_share * (left - course.pressure);
    course.op += stem_share * (1.0 - left - course.op);
    course.behind += stem_share * (-1.0 - course.behind);
  }
  return course;
}

}  // namespace

StemFriction<double> stem_friction(const Valve& valve) {
  const bool slips = valve.law == ValveLaw::he;
  StemFriction<double> stem;
  stem.breakaway = 0.5 * (valve.stickband_percent + valve.slip_jump_percent);
  stem.behind = 0.5 * (valve.stickband_percent - valve.slip_jump_percent);
  stem.pressure_share = share_of_way(valve.between.actuator_lag_samples);
  stem.pressure_left = std::exp(-1.0 / valve.between.actuator_lag_samples);
  stem.stem_share = slips ? 1.0 : share_of_way(valve.between.stem_lag_samples);
  const double least_way = valve.between.resting_speed * valve.stickband_percent / kLooks;
  const double more =
      least_way > 0.0 ? least_way / stem.stem_share : -kTurn * valve.stickband_percent;
  stem.least_gap = stem.behind + more;
  stem.but_one_look = course_of(kLooks - 1, stem.pressure_share, stem.stem_share);
  stem.sample = course_of(kLooks, stem.pressure_share, stem.stem_share);
  return stem;
}

}  // namespace loopscope::core::model
