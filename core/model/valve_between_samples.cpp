#include "core/model/valve_between_samples.hpp"

#include <cmath>
#include <cstddef>

namespace loopscope::core::model {
namespace {

/// Looks a sample. Stems that were simulated in 20 steps a sample are followed as well by 8, the
/// lag making up for the rest, and not by 3 (README.valves.md).
constexpr int kLooks = 8;

/// What a first-order lag goes of its way in one look; all of it without a lag.
double share_of_way(double lag_samples) {
  return lag_samples > 0.0 ? 1.0 - std::exp(-1.0 / (kLooks * lag_samples)) : 1.0;
}

/// Where a stem that moves on all along is after some looks: the sum of shares of where it was, of
/// where the pressure was, of op and of how far it stays behind.
struct Course {
  double own = 1.0, pressure = 0.0, op = 0.0, behind = 0.0;
};

/// After that many looks; `pressure_share` and `stem_share` of their ways in each.
Course course_of(int looks, double pressure_share, double stem_share) {
  Course course;
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

class Stem {
 public:
  Stem(const Valve& valve, double op)
      : breakaway_(0.5 * (valve.stickband_percent + valve.slip_jump_percent)),
        behind_(0.5 * (valve.stickband_percent - valve.slip_jump_percent)),
        pressure_share_(share_of_way(valve.between.actuator_lag_samples)),
        pressure_left_(std::exp(-1.0 / valve.between.actuator_lag_samples)),
        stem_share_(valve.law == ValveLaw::he ? 1.0 : share_of_way(valve.between.stem_lag_samples)),
        least_way_(valve.between.resting_speed * valve.stickband_percent / kLooks),
        slips_(valve.law == ValveLaw::he),
        but_one_look_(course_of(kLooks - 1, pressure_share_, stem_share_)),
        sample_(course_of(kLooks, pressure_share_, stem_share_)),
        pressure_(op),
        place_(op - valve.start_direction * behind_) {}

  void put(double place) { place_ = place; }

  double step(double op) {
    // The pressure goes straight from where it is to op: where neither moves the stem, it rests.
    const bool rests = direction_ == 0.0 && holds(pressure_) && holds(op);
    if (rests || moves_all_along(op)) {
      pressure_ = op + pressure_left_ * (pressure_ - op);
      return place_;
    }
    for (int i = 0; i < kLooks; ++i) look(op);
    return place_;
  }

 private:
  [[nodiscard]] bool holds(double pressure) const {
    return std::abs(pressure - place_) <= breakaway_;
  }

  [[nodiscard]] double after(const Course& course, double op) const {
    return course.own * place_ + course.pressure * pressure_ + course.op * op +
           course.behind * direction_ * behind_;
  }

  /// Whether a moving stem does not come to rest in this sample, and then it is where it ends. Its
  /// ways rise and fall at most once while the pressure goes on: the first and the last are least.
  bool moves_all_along(double op) {
    if (direction_ == 0.0 || (op - pressure_) * direction_ <= 0.0) return false;
    const double pressure = pressure_ + pressure_share_ * (op - pressure_);
    const double first = stem_share_ * (pressure - direction_ * behind_ - place_) * direction_;
    const double end = after(sample_, op);
    const double last = (end - after(but_one_look_, op)) * direction_;
    if (first <= least_way_ || last <= least_way_) return false;
    place_ = end;
    return true;
  }

  void look(double op) {
    pressure_ += pressure_share_ * (op - pressure_);
    if (direction_ == 0.0) {
      if (holds(pressure_)) return;
      direction_ = pressure_ > place_ ? 1.0 : -1.0;
    }
    const double way = stem_share_ * (pressure_ - direction_ * behind_ - place_);
    const bool ahead = way * direction_ > 0.0;
    if (ahead) place_ += way;
    if (slips_ || !ahead || way * direction_ < least_way_) direction_ = 0.0;
  }

  double breakaway_;
  double behind_;  ///< how far a moving stem stays behind the pressure
  double pressure_share_;
  double pressure_left_;  ///< of its way to op after a sample
  double stem_share_;
  double least_way_;  ///< in a look
  bool slips_;
  Course but_one_look_, sample_;
  double pressure_;
  double place_;
  double direction_ = 0.0;  ///< of a moving stem; 0 = it rests
};

}  // namespace

void run_between_samples(const Valve& valve, double first_op,
                         std::span<const ValveRestart> restarts, std::span<const double> op,
                         std::span<double> mv) {
  Stem stem(valve, first_op);
  double place = first_op;
  std::size_t next = 0;
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (next < restarts.size() && restarts[next].at_sample == k) {
      place = restarts[next++].position_percent;
      stem.put(place);
    }
    if (!std::isnan(op[k])) place = stem.step(op[k]);
    mv[k] = place;
  }
}

}  // namespace loopscope::core::model
