#pragma once

#include <cstddef>
#include <limits>

#include "core/model/stem_friction.hpp"

namespace loopscope::core::model {

/// The stems of valve_between_samples.hpp, as many as a Number has (double: one), side by side under
/// the same op. Choices instead of branches, but for what all of them do: mostly all of them rest.
template <typename Number>
class Stems {
 public:
  using Element = typename ElementOf<Number>::type;
  using Mask = MaskOf<Number>;

  /// Stem `at`, which has just come to rest in the valve's direction at that op.
  void put_in(std::size_t at, const Valve& valve, double op) {
    const StemFriction<double> one = stem_friction(valve);
    friction_.put(at, one);
    element(pressure_, at) = static_cast<Element>(op);
    put(at, op - valve.start_direction * one.behind);
  }
  /// It stands elsewhere, moving on or not.
  void put(std::size_t at, double place) { element(place_, at) = static_cast<Element>(place); }

  [[nodiscard]] const Number& place() const { return place_; }

  /// What the next op makes of the pressures where no stem moves.
  void build_up(Element op) { pressure_ = built_up(Number{} + op); }

  /// The next sample of op; law `he` or `kano`.
  template <ValveLaw law>
  void step(Element next) {
    const Number op = Number{} + next;
    const Mask rest = resting(op);
    if (holds_for_all(rest)) return build_up(next);
    if constexpr (law == ValveLaw::he) {
      look_again(op, rest, place_);
    } else {
      step_moving(op, rest);
    }
  }

  /// Every op from `lowest` to `highest` leaves all of them at rest; they are drawn together.
  void narrow(Number& lowest, Number& highest) const {
    constexpr Element kNever = std::numeric_limits<Element>::max();
    const Mask rest = resting(pressure_);
    const Number low = rest ? place_ - friction_.breakaway : Number{} + kNever;
    const Number high = rest ? place_ + friction_.breakaway : Number{} - kNever;
    lowest = low > lowest ? low : lowest;
    highest = high < highest ? high : highest;
  }

 private:
  [[nodiscard]] Mask holds(Number pressure) const {
    const Number gap = pressure - place_;
    return Mask((gap <= friction_.breakaway) & (gap >= -friction_.breakaway));
  }
  /// The pressure goes straight from where it is to op: where neither moves the stem, it rests.
  [[nodiscard]] Mask resting(Number op) const {
    return Mask((direction_ == Number{}) & holds(pressure_) & holds(op));
  }
  [[nodiscard]] Number built_up(Number op) const {
    return op + friction_.pressure_left * (pressure_ - op);
  }

  [[nodiscard]] Number after(const StemCourse<Number>& course, Number op) const {
    return course.own * place_ + course.pressure * pressure_ + course.op * op +
           course.behind * direction_ * friction_.behind;
  }

  /// Those that do not come to rest in this sample, and then they are where they `end`. Their ways
  /// rise and fall at most once while the pressure goes on: the first and the last are least.
  [[nodiscard]] Mask moving_all_along(Number op, Number& end) const {
    const Number zero{};
    const Number least = friction_.stem_share * (friction_.least_gap - friction_.behind);
    const Number pressure = pressure_ + friction_.pressure_share * (op - pressure_);
    const Number gap = pressure - direction_ * friction_.behind - place_;
    const Number first = friction_.stem_share * gap * direction_;
    end = after(friction_.sample, op);
    const Number last = (end - after(friction_.but_one_look, op)) * direction_;
    return Mask(((op - pressure_) * direction_ > zero) & (first > least) & (last > least));
  }

  void step_moving(Number op, Mask rest) {
    Number end = place_;
    const Mask along = moving_all_along(op, end);
    end = along ? end : place_;
    if (!holds_for_all(Mask(rest | along))) return look_again(op, rest, along, end);
    pressure_ = built_up(op);
    place_ = end;
  }

  /// He's: there at once, and at rest again.
  void look_again(Number op, Mask rest, Number place) {
    const Number behind = friction_.behind, breakaway = friction_.breakaway;
    Number pressure = pressure_;
    for (int i = 0; i < kLooks; ++i) {
      pressure += friction_.pressure_share * (op - pressure);
      // The next look waits for the place: whatever does not depend on it is known by then.
      const Mask up = pressure - breakaway > place;
      const Mask down = pressure + breakaway < place;
      const Number above = down ? pressure + behind : place;
      place = up ? pressure - behind : above;
    }
    pressure_ = rest ? built_up(op) : pressure;
    place_ = rest ? place_ : place;
  }

  /// Kano's, where `settled` ones rest or have come to their `end`.
  void look_again(Number op, Mask rest, Mask along, Number end) {
    const Number zero{}, behind = friction_.behind, breakaway = friction_.breakaway;
    Number pressure = pressure_, place = place_;
    Mask up = direction_ > zero, down = direction_ < zero;
    for (int i = 0; i < kLooks; ++i) {
      pressure += friction_.pressure_share * (op - pressure);
      const Mask stands = Mask(!(up | down));
      up = Mask(up | (stands & (pressure - breakaway > place)));
      down = Mask(down | (stands & (pressure + breakaway < place)));
      const Number target = up ? pressure - behind : pressure + behind;
      up = Mask(up & (target > place));
      down = Mask(down & (target < place));
      const Number way = friction_.stem_share * (target - place);
      const Mask fast_up = pressure - friction_.least_gap >= place;
      const Mask fast_down = pressure + friction_.least_gap <= place;
      place += Mask(up | down) ? way : zero;
      up = Mask(up & fast_up);
      down = Mask(down & fast_down);
    }
    const Mask settled = Mask(rest | along);
    const Number one = zero + Element{1};
    const Number direction = (up ? one : zero) - (down ? one : zero);
    direction_ = settled ? direction_ : direction;
    pressure_ = settled ? built_up(op) : pressure;
    place_ = settled ? end : place;
  }

  StemFriction<Number> friction_;
  Number pressure_{};
  Number place_{};
  Number direction_{};  ///< of a moving stem; 0 = it rests
};

}  // namespace loopscope::core::model
