// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_STEMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_STEMS_INL
#undef LOOPSCOPE_MODEL_STEMS_INL
#else
#define LOOPSCOPE_MODEL_STEMS_INL
#endif

#include <array>
#include <cstddef>
#include <cstring>
#include <hwy/highway.h>
#include <limits>
#include <type_traits>

#include "core/model/valve_law/stem_friction.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

template <std::size_t bytes>
struct LongsOf {
  using type __attribute__((vector_size(bytes))) = long long;
};

/// Copies of memory: what returns a vector has to belong to the kind of processor, and
/// std::bit_cast does not.
template <std::size_t bytes, typename Bits>
bool all_bits(const Bits& bits) {
  if constexpr (bytes == 2 * sizeof(long long)) {
    typename LongsOf<bytes>::type pair;
    std::memcpy(&pair, &bits, bytes);
    return (pair[0] & pair[1]) == -1;
  } else {
    std::array<typename LongsOf<bytes / 2>::type, 2> halves;
    std::memcpy(&halves, &bits, bytes);
    return all_bits<bytes / 2>(halves[0] & halves[1]);
  }
}

/// Whether the condition holds for each of the numbers side by side.
template <typename Mask>
bool holds_for_all(const Mask& mask) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask;
  } else {
    return all_bits<sizeof(Mask)>(mask);
  }
}

/// A pressure after a sample in which so much of its way to op is left: what waits for the one
/// before is a product and a sum.
template <typename Number>
Number passed_on(Number pressure, Number left, Number op) {
  return left * pressure + (op - left * op);
}

/// The stems of valve_between_samples.hpp, as many as a Number has (double: one), side by side
/// under the same op. Choices instead of branches, but for what all of them do: mostly all of them
/// rest.
template <typename Number>
class alignas(sizeof(Number)) Stems {
 public:
  using Element = typename ElementOf<Number>::type;
  using Mask = MaskOf<Number>;

  /// Stem `at`, which has just come to rest in the valve's direction at that op.
  void put_in(std::size_t at, const Valve& valve, double op) {
    const StemFriction<double> one = stem_friction(valve);
    friction_.put(at, one);
    put_element(pressure_, at, op);
    put_element(place_, at, valve.start_percent.value_or(op - valve.start_direction * one.behind));
  }

  [[nodiscard]] const Number& place() const { return place_; }

  /// The pressures, which follow op where no stem moves, and what is left of their way to it then.
  [[nodiscard]] Number& pressure() { return pressure_; }
  [[nodiscard]] const Number& pressure_left() const { return friction_.pressure_left; }

  /// The next sample of op; law `he` or `kano`.
  template <ValveLaw law>
  void step(Element next) {
    step_together<law, 1>(this, next);
  }

  /// The same of `count` in a row. From look to look each of them waits for its place: together
  /// they hide the time.
  template <ValveLaw law, std::size_t count>
  static void step_together(Stems* stems, Element next) {
    const Number op = Number{} + next;
    Number end[count];
    Mask settled[count];
    for (std::size_t i = 0; i < count; ++i) {
      end[i] = settled_end<law>(stems[i], op, settled[i]);
    }
    Mask all = settled[0];
    for (std::size_t i = 1; i < count; ++i) all = Mask(all & settled[i]);
    if (!holds_for_all(all)) return look_again<law, count>(stems, op, settled, end);
    for (std::size_t i = 0; i < count; ++i) {
      stems[i].pressure_ = stems[i].built_up(op);
      stems[i].place_ = end[i];
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
    const Mask stands = direction_ == Number{}, held = holds(pressure_), kept = holds(op);
    return Mask(stands & held & kept);
  }
  [[nodiscard]] Number built_up(Number op) const {
    return passed_on(pressure_, friction_.pressure_left, op);
  }

  [[nodiscard]] Number after(const StemCourse<Number>& course, Number op) const {
    return course.own * place_ + course.pressure * pressure_ + course.op * op +
           course.behind * direction_ * friction_.behind;
  }

  /// Those that do not come to rest in this sample, and where they `end` then. Their ways rise and
  /// fall at most once while the pressure goes on: the first and the last are least.
  [[nodiscard]] Mask moving_all_along(Number op, Number& end) const {
    const Number zero{};
    const Number least = friction_.stem_share * (friction_.least_gap - friction_.behind);
    const Number pressure = pressure_ + friction_.pressure_share * (op - pressure_);
    const Number gap = pressure - direction_ * friction_.behind - place_;
    const Number first = friction_.stem_share * gap * direction_;
    end = after(friction_.sample, op);
    const Number last = (end - after(friction_.but_one_look, op)) * direction_;
    const Mask onwards = (op - pressure_) * direction_ >= zero;
    return Mask(onwards & (direction_ != zero) & (first > least) & (last > least));
  }

  /// What changes from look to look.
  struct alignas(sizeof(Number)) Moment {
    Number pressure, place;
    Mask up, down;  ///< where a moving stem moves
  };

  /// Where those end that neither break loose nor come to rest in this sample.
  template <ValveLaw law>
  static Number settled_end(const Stems& stems, Number op, Mask& settled) {
    const Mask rest = stems.resting(op);
    Number end = stems.place_;
    settled = rest;
    if constexpr (law == ValveLaw::kano) settled = Mask(rest | stems.moving_all_along(op, end));
    return rest ? stems.place_ : end;
  }

  /// Those that have `settled`, at `end`, are left there.
  template <ValveLaw law, std::size_t count>
  static void look_again(Stems* stems, Number op, const Mask* settled, const Number* end) {
    const Number none{}, one = none + Element{1};
    Moment now[count];
    for (std::size_t i = 0; i < count; ++i)
      now[i] = {stems[i].pressure_, stems[i].place_, stems[i].direction_ > none,
                stems[i].direction_ < none};
    for (int look = 0; look < kLooks; ++look) {
#pragma GCC unroll 4
      for (std::size_t i = 0; i < count; ++i) {
        now[i].pressure += stems[i].friction_.pressure_share * (op - now[i].pressure);
        law == ValveLaw::he ? stems[i].slip(now[i]) : stems[i].follow(now[i]);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Number direction = (now[i].up ? one : none) - (now[i].down ? one : none);
      stems[i].direction_ = settled[i] ? stems[i].direction_ : direction;
      stems[i].pressure_ = settled[i] ? stems[i].built_up(op) : now[i].pressure;
      stems[i].place_ = settled[i] ? end[i] : now[i].place;
    }
  }

  // The next look waits for the place of this one: whatever does not depend on it is known by then.

  /// By `he`: there at once, and at rest again.
  void slip(Moment& now) const {
    const Mask up = now.pressure - friction_.breakaway > now.place;
    const Mask down = now.pressure + friction_.breakaway < now.place;
    const Number above = down ? now.pressure + friction_.behind : now.place;
    now.place = up ? now.pressure - friction_.behind : above;
  }

  /// By `kano`: breaks loose, moves on and may come to rest. Both ways are known before it is known
  /// which is gone.
  void follow(Moment& now) const {
    const Number none{};
    const Number gap_up = now.pressure - friction_.behind - now.place;
    const Number gap_down = now.pressure + friction_.behind - now.place;
    const Mask stands = Mask(!(now.up | now.down));
    const Mask up = Mask(now.up | (stands & (now.pressure - friction_.breakaway > now.place)));
    const Mask down = Mask(now.down | (stands & (now.pressure + friction_.breakaway < now.place)));
    now.up = Mask(up & (now.pressure - friction_.least_gap >= now.place));
    now.down = Mask(down & (now.pressure + friction_.least_gap <= now.place));
    const Number way_up = Mask(up & (gap_up > none)) ? friction_.stem_share * gap_up : none;
    const Number way_down = Mask(down & (gap_down < none)) ? friction_.stem_share * gap_down : none;
    now.place += way_up + way_down;
  }

  StemFriction<Number> friction_;
  Number pressure_{};
  Number place_{};
  Number direction_{};  ///< of a moving stem; 0 = it rests
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_STEMS_INL
