#pragma once

#include <array>
#include <cstddef>

#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

namespace loopscope::core::model {

/// Looks a sample at a stem between the samples. Stems that were simulated in 20 steps a sample are
/// followed as well by 8, the lag making up for the rest, and not by 3
/// (core/model/valve_search/README.md).
inline constexpr int kLooks = 8;

/// Where a stem that moves on all along is after some looks: the sum of shares of where it was, of
/// where the pressure was, of op and of how far it stays behind.
template <typename Number>
struct alignas(sizeof(Number)) StemCourse {
  Number own{}, pressure{}, op{}, behind{};
};

/// What a valve that is looked at between the samples is made of, % of op and shares. Of one
/// (double), or of as many as a Number has.
template <typename Number>
struct alignas(sizeof(Number)) StemFriction {
  Number breakaway{};       ///< how far from the pressure it breaks loose
  Number behind{};          ///< how far a moving stem stays behind the pressure
  Number least_gap{};       ///< to the pressure; with a smaller one a moving stem is too slow
  Number pressure_share{};  ///< that the pressure goes of its way to op in one look
  Number pressure_left{};   ///< of that way after a sample
  Number stem_share{};      ///< that the stem goes of its way in one look
  StemCourse<Number> but_one_look{}, sample{};

  /// Number `at` becomes such a stem.
  void put(std::size_t at, const StemFriction<double>& one);
};

/// Of a valve that does not act at the samples; law `he` or `kano`.
[[nodiscard]] StemFriction<double> stem_friction(const Valve& valve);

template <typename Number>
void StemFriction<Number>::put(std::size_t at, const StemFriction<double>& one) {
  const auto set = [at](Number& numbers, double value) { put_element(numbers, at, value); };
  const auto set_course = [&](StemCourse<Number>& courses, const StemCourse<double>& course) {
    set(courses.own, course.own);
    set(courses.pressure, course.pressure);
    set(courses.op, course.op);
    set(courses.behind, course.behind);
  };
  set(breakaway, one.breakaway);
  set(behind, one.behind);
  set(least_gap, one.least_gap);
  set(pressure_share, one.pressure_share);
  set(pressure_left, one.pressure_left);
  set(stem_share, one.stem_share);
  set_course(but_one_look, one.but_one_look);
  set_course(sample, one.sample);
}

}  // namespace loopscope::core::model
