#include "tests/core/model/field_loop.hpp"

#include <cmath>
#include <numbers>

#include "tests/generators/delay.hpp"
#include "tests/generators/friction.hpp"
#include "tests/generators/pi_controller.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::model {
namespace {

constexpr double kMiddle = 50.0;
constexpr std::size_t kRunIn = 800;

using generators::to_grid;

class Wave {
 public:
  Wave(const OutsideWave& settings, Draw& draw) : settings_(settings), phase_(draw.between(0, 1)) {}
  double next(Draw& draw) {
    if (settings_.amplitude == 0.0) return 0.0;
    phase_ += 1.0 / settings_.period_steps +
              settings_.phase_walk / (2.0 * std::numbers::pi) * draw.normal();
    // The amplitude forgets itself over about three cycles.
    const double memory = std::exp(-1.0 / (3.0 * settings_.period_steps));
    fade_ = memory * fade_ + settings_.fading * std::sqrt(1.0 - memory * memory) * draw.normal();
    const double place = phase_ - std::floor(phase_);
    return settings_.amplitude * (1.0 + fade_) * shape(place);
  }
  [[nodiscard]] bool at_input() const { return settings_.at_input; }

 private:
  [[nodiscard]] double shape(double place) const {
    switch (settings_.shape) {
      case OutsideWave::Shape::sine:
        return std::sin(2.0 * std::numbers::pi * place);
      case OutsideWave::Shape::square:
        return place < 0.5 ? 1.0 : -1.0;
      case OutsideWave::Shape::triangle:
        return 4.0 * std::abs(place - 0.5) - 1.0;
      case OutsideWave::Shape::lopsided:
        return place < 0.3 ? 2.0 * place / 0.3 - 1.0 : 1.0 - 2.0 * (place - 0.3) / 0.7;
    }
    return 0.0;
  }
  OutsideWave settings_;
  double phase_;
  double fade_ = 0.0;
};

/// Stem position under friction: He's quasi-static law, or Karnopp's equation of motion.
class Stem {
 public:
  explicit Stem(const FieldValve& valve)
      : valve_(valve),
        friction_(generators::friction_of(valve.stickband_percent, valve.slip_jump_percent)) {}
  double next(double op, Draw& draw) {
    const double before = position_;
    const double after = moved(op);
    if (valve_.spread > 0.0 && after == before && moves_)
      uneven_ = std::exp(valve_.spread * draw.normal());
    moves_ = after != before;
    return after;
  }

 private:
  double moved(double op) {
    const bool away = valve_.stretch_steps > 0 && step_++ / valve_.stretch_steps % 2 == 1;
    if (away) velocity_ = 0.0;
    if (valve_.friction == Friction::none || away) return position_ = op;
    if (valve_.friction == Friction::he)
      return position_ = generators::slipped(position_, op, on_the_way(op - position_));
    for (int i = 0; i < kSubSteps; ++i) karnopp(op);
    return position_;
  }
  static constexpr int kSubSteps = 20;
  /// Friction against a motion with this sign.
  [[nodiscard]] generators::Friction on_the_way(double force) const {
    const double scale = uneven_ * (force > 0.0 ? 1.0 + valve_.asymmetry : 1.0 - valve_.asymmetry);
    return {friction_.static_friction * scale, friction_.kinetic_friction * scale};
  }
  void karnopp(double op) {
    constexpr double kStep = 1.0 / kSubSteps, kMass = 0.002, kViscous = 0.08, kRest = 0.02;
    const double force = op - position_;
    if (std::abs(velocity_) < kRest) {
      const generators::Friction friction = on_the_way(force);
      if (std::abs(force) <= friction.static_friction) {
        velocity_ = 0.0;
        return;
      }
      velocity_ += kStep * 0.1 * (force - std::copysign(friction.kinetic_friction, force)) / kMass;
    }
    const double sign = velocity_ > 0.0 ? 1.0 : -1.0;
    // Viscous drag is stiff against the step: taken implicitly.
    const double drive = force - sign * on_the_way(sign).kinetic_friction;
    const double moved = (velocity_ + kStep * drive / kMass) / (1.0 + kStep * kViscous / kMass);
    velocity_ = moved * sign < 0.0 ? 0.0 : moved;
    position_ += kStep * velocity_;
  }
  FieldValve valve_;
  generators::Friction friction_;
  double position_ = kMiddle;
  double velocity_ = 0.0;
  double uneven_ = 1.0;  ///< friction of this stroke by the mean one
  bool moves_ = false;
  std::size_t step_ = 0;
};

class Noise {
 public:
  Noise(NoiseKind kind, double std) : kind_(kind), std_(std) {}
  double next(Draw& draw) {
    const double normal = std_ * draw.normal();
    if (kind_ == NoiseKind::t5) return normal / spread(draw);
    if (kind_ == NoiseKind::bursts) return normal * loudness(draw);
    return normal;
  }

 private:
  /// Root of chi square over its degrees of freedom, so that the quotient has the variance 1.
  static double spread(Draw& draw) {
    constexpr int kFreedom = 5;
    double squares = 0.0;
    for (int i = 0; i < kFreedom; ++i) {
      const double normal = draw.normal();
      squares += normal * normal;
    }
    return std::sqrt(squares / (kFreedom - 2.0));
  }
  double loudness(Draw& draw) {
    constexpr double kLoud = 4.0, kShare = 0.2, kMeanSteps = 50.0;
    if (draw.chance(1.0 / (kMeanSteps * (loud_ ? 1.0 : 1.0 / kShare - 1.0)))) loud_ = !loud_;
    static const double root_mean_square = std::sqrt(kShare * kLoud * kLoud + 1.0 - kShare);
    return (loud_ ? kLoud : 1.0) / root_mean_square;
  }
  NoiseKind kind_;
  double std_;
  bool loud_ = false;
};

double pole(double lag) {
  return lag > 0.0 ? std::exp(-1.0 / lag) : 0.0;
}

class Plant {
 public:
  explicit Plant(const FieldSettings& s)
      : s_(s), pipe_(s.dead_steps), a1_(pole(s.lag_steps)), a2_(pole(s.second_lag_steps)) {}
  double next(double flow) {
    const double late = pipe_.step(flow);
    first_ = s_.integrating ? first_ + s_.gain * late : a1_ * first_ + (1.0 - a1_) * s_.gain * late;
    second_ = a2_ * second_ + (1.0 - a2_) * first_;
    return second_;
  }

 private:
  FieldSettings s_;
  generators::Delay pipe_;
  double a1_, a2_, first_ = 0.0, second_ = 0.0;
};

class Sensor {
 public:
  explicit Sensor(const Recording& r) : r_(r) {}
  double next(double value, Draw& draw) {
    wander_ = 0.99 * wander_ + r_.sensor_wander * std::sqrt(1.0 - 0.99 * 0.99) * draw.normal();
    if (step_++ % r_.sensor_hold != 0) return reading_;
    double seen = value + wander_;
    if (r_.spike_rate > 0.0 && draw.chance(r_.spike_rate)) seen += 8.0 * r_.sensor_wander;
    if (std::abs(seen - reading_) > r_.sensor_dead_zone) reading_ = to_grid(seen, r_.pv_grid);
    return reading_;
  }

 private:
  Recording r_;
  double wander_ = 0.0, reading_ = 0.0;
  std::size_t step_ = 0;
};

/// Dead-band compression: a value is kept when it leaves the band around the last kept one.
void archive(std::vector<double>& values, double band, double grid, bool interpolate) {
  if (band > 0.0) {
    std::size_t kept = 0;
    for (std::size_t k = 1; k < values.size(); ++k) {
      const bool last = k + 1 == values.size();
      if (std::abs(values[k] - values[kept]) <= band && !last) continue;
      for (std::size_t i = kept + 1; i < k; ++i) {
        const double share = static_cast<double>(i - kept) / static_cast<double>(k - kept);
        values[i] = interpolate ? values[kept] + share * (values[k] - values[kept]) : values[kept];
      }
      kept = k;
    }
  }
  for (double& value : values) value = to_grid(value, grid);
}

}  // namespace

double Draw::log_between(double low, double high) {
  return low * std::pow(high / low, uniform_.next());
}

std::size_t Draw::whole(std::size_t low, std::size_t high) {
  return low + static_cast<std::size_t>(uniform_.next() * static_cast<double>(high - low + 1));
}

FieldLoop run_field_loop(const FieldSettings& s, std::size_t samples, Draw& draw) {
  Plant plant(s);
  Sensor sensor(s.recording);
  Noise noise(s.noise, s.noise_std);
  Stem stem(s.valve);
  std::vector<Wave> waves;
  for (const OutsideWave& wave : s.waves) waves.emplace_back(wave, draw);
  Wave master(s.master, draw);
  FieldLoop loop;
  const double actuator = pole(s.actuator_lag_steps), filter = pole(s.filter_steps);
  generators::PiController controller(kMiddle, {s.op_low, s.op_high});
  const double load_pole = pole(s.load_lag_steps);
  double air = kMiddle, seen = 0.0, load = 0.0, late_load = 0.0, pv = 0.0, sp_base = 0.0,
         sp_walk = 0.0;
  const std::size_t steps = kRunIn + samples * s.recording.every;
  for (std::size_t k = 0; k < steps; ++k) {
    load = s.load_memory * load + s.load_step_std * draw.normal();
    late_load = load_pole * late_load + (1.0 - load_pole) * load;
    double at_input = late_load, at_output = 0.0;
    for (Wave& wave : waves) (wave.at_input() ? at_input : at_output) += wave.next(draw);
    if (!s.neighbour.empty()) at_output += s.neighbour[k % s.neighbour.size()];
    air = actuator * air + (1.0 - actuator) * to_grid(controller.op(), s.op_step);
    const double mv = stem.next(air, draw);
    const double flow = (mv - kMiddle) * (1.0 + s.trim * (mv - kMiddle) / kMiddle);
    pv = plant.next(flow + at_input) + at_output;
    seen = filter * seen + (1.0 - filter) * pv;
    const double reading = sensor.next(seen + noise.next(draw), draw);
    const double op_before = to_grid(controller.op(), s.op_step);
    if (s.setpoint_every > 0.0 && draw.chance(1.0 / s.setpoint_every)) {
      sp_base = s.setpoint_step_std * draw.normal();
    }
    sp_walk = 0.99 * sp_walk + s.master_walk * std::sqrt(1.0 - 0.99 * 0.99) * draw.normal();
    const double sp = sp_base + sp_walk + master.next(draw);
    if (k % s.controller_every == 0) {
      controller.step(sp - reading, s.controller_gain, s.integral_steps,
                      static_cast<double>(s.controller_every));
    }
    const double op = to_grid(controller.op(), s.op_step);
    if (k < kRunIn) continue;
    const double op_kept = s.recording.pv_late ? op_before : op;
    if ((k - kRunIn) % s.recording.every == 0) {
      loop.sp.push_back(100.0 + sp);
      loop.pv.push_back(100.0 + reading);
      loop.op.push_back(op_kept);
      loop.mv.push_back(mv);
    } else if (s.recording.means) {
      const double share = 1.0 / static_cast<double>((k - kRunIn) % s.recording.every + 1);
      loop.pv.back() += share * (100.0 + reading - loop.pv.back());
      loop.op.back() += share * (op_kept - loop.op.back());
    }
  }
  const Recording& r = s.recording;
  archive(loop.pv, r.archive_band_pv, r.archive_grid_pv, r.interpolate);
  archive(loop.op, r.archive_band_op, r.archive_grid_op, r.interpolate);
  return loop;
}

}  // namespace loopscope::tests::model
