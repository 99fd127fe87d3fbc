#include "core/diagnosis/shape_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace loopscope::core::diagnosis {
namespace {

using Value = std::optional<double>;

template <auto member>
Value shape_figure(const Evidence& evidence) {
  return evidence.shape.*member;
}

/// Level loops have no say in Horch's cross-correlation.
template <auto member>
Value horch(const Evidence& evidence) {
  return evidence.integrating ? std::nullopt : evidence.shape.*member;
}

template <auto member>
Value cycle_figure(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  return evidence.cycle->evidence.*member;
}

/// Of a vessel the slope of pv is what the valve's flow makes.
Value mean_cycle_kurtosis(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  const model::CycleEvidence& cycle = evidence.cycle->evidence;
  return evidence.integrating ? cycle.pv_bend_kurtosis : cycle.pv_move_kurtosis;
}

Value cycle_odds(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  constexpr double kLeast = 1e-4;
  const double score = std::clamp(evidence.cycle->score, kLeast, 1.0 - kLeast);
  return std::log(score / (1.0 - score));
}

/// Share of the linear error that a valve takes away in the cycle's band.
Value law_gain(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  const model::CycleEvidence& cycle = evidence.cycle->evidence;
  if (!(cycle.error_before > 0.0)) return std::nullopt;
  return 1.0 - cycle.error_law / cycle.error_before;
}

template <auto member>
Value travel_gain(const Evidence& evidence) {
  const std::optional<model::SlowTravel>& travel = evidence.*member;
  if (!travel || !(travel->error_before() > 0.0)) return std::nullopt;
  return 1.0 - travel->error_after() / travel->error_before();
}

template <auto member>
Value travel_figure(const Evidence& evidence) {
  if (!evidence.travel) return std::nullopt;
  return (*evidence.travel).*member;
}

template <auto member>
Value rests_figure(const Evidence& evidence) {
  if (!evidence.rests) return std::nullopt;
  return (*evidence.rests).*member;
}

template <auto member>
Value op_rest(const Evidence& evidence) {
  if (!evidence.op_rest) return std::nullopt;
  return (*evidence.op_rest).*member;
}

Value ellipse(const Evidence& evidence) {
  constexpr double kConclusive = 0.5;
  if (evidence.shape.ellipse_r2.value_or(0.0) < kConclusive) return std::nullopt;
  return evidence.shape.ellipse_stiction;
}

constexpr std::array kShapeFigures = {
    Figure{"shape.index", "wave shape index, 0 sine, 1 triangle", Scale::plain,
           shape_figure<&loop::Shape::shape_index>},
    Figure{"shape.dtau", "cross-correlation of op and pv is odd, dtau", Scale::plain,
           horch<&loop::Shape::horch_dtau>},
    Figure{"shape.drho", "cross-correlation of op and pv is odd, drho", Scale::plain,
           horch<&loop::Shape::horch_drho>},
    Figure{"shape.ellipse", "width of the pv-op plot in percent of op's span", Scale::plain,
           ellipse},
    Figure{"position.width", "width of the recorded mv-op plot, %", Scale::plain,
           shape_figure<&loop::Shape::mv_op_width>},
    Figure{"position.jump", "jump of the recorded valve position when it leaves rest, %",
           Scale::plain, shape_figure<&loop::Shape::mv_slip_jump>},
    Figure{"position.stuck", "time in which the recorded valve position stands while op moves",
           Scale::share, shape_figure<&loop::Shape::mv_stuck_fraction>},
    Figure{"cycle.odds", "log odds of a sticking valve by the shape of the cycle", Scale::plain,
           cycle_odds},
    Figure{"cycle.cycles", "cycles in the record", Scale::plain,
           cycle_figure<&model::CycleEvidence::cycles>},
    Figure{"cycle.op_coherence", "op repeats its half cycle", Scale::share,
           cycle_figure<&model::CycleEvidence::op_coherence>},
    Figure{"cycle.op_triangle", "op's cycle is triangular, 0 sine, 0.11 triangle", Scale::plain,
           cycle_figure<&model::CycleEvidence::op_triangle>},
    Figure{"cycle.pv_third", "third harmonic of pv's cycle, 0 sine, 0.33 square", Scale::plain,
           cycle_figure<&model::CycleEvidence::pv_third>},
    Figure{"cycle.pv_triangle", "wave shape index of pv's cycle, 0 sine, 1 triangle", Scale::plain,
           cycle_figure<&model::CycleEvidence::pv_triangle>},
    Figure{"cycle.pv_coherence", "pv repeats its half cycle", Scale::share,
           cycle_figure<&model::CycleEvidence::pv_coherence>},
    Figure{"cycle.pv_jumps", "kurtosis of the moves of pv's mean cycle, 1.5 sine, more for jumps",
           Scale::plain, mean_cycle_kurtosis},
    Figure{"cycle.op_ramps", "kurtosis of the moves of op's mean cycle, 1 ramps, 1.5 sine",
           Scale::plain, cycle_figure<&model::CycleEvidence::op_move_kurtosis>},
    Figure{"cycle.steadiness", "parts of the record in which a valve explains the cycle better",
           Scale::share, cycle_figure<&model::CycleEvidence::steadiness>},
    Figure{"cycle.part_ratio", "error of the cycle with a valve by that of a linear process",
           Scale::plain, cycle_figure<&model::CycleEvidence::part_ratio>},
    Figure{"cycle.band_share", "stickband of the cycle by op's travel", Scale::share,
           cycle_figure<&model::CycleEvidence::band_share>},
    Figure{"cycle.law_gain", "error of the cycle that a sticking valve takes away", Scale::share,
           law_gain},
    Figure{"cycle.linear_error", "error of the cycle that a linear process leaves", Scale::share,
           cycle_figure<&model::CycleEvidence::error_before>},
    Figure{"travel.gain", "error of op's slow travel that a sticking valve takes away",
           Scale::share, travel_gain<&Evidence::travel>},
    Figure{"travel.cycle_gain", "error of op's travel in a slow cycle that a sticking valve takes away",
           Scale::share, travel_gain<&Evidence::cycle_travel>},
    Figure{"travel.linear", "share of pv that follows op's slow travel", Scale::share,
           travel_figure<&model::SlowTravel::linear_share>},
    Figure{"travel.valve", "share of pv that follows op's slow travel behind a sticking valve",
           Scale::share, travel_figure<&model::SlowTravel::valve_share>},
    Figure{"rests.kurtosis", "kurtosis of pv's moves within the cycle, 1.5 sine", Scale::plain,
           rests_figure<&loop::Rests::move_kurtosis>},
    Figure{"rests.time", "time in which pv rests within the cycle", Scale::share,
           rests_figure<&loop::Rests::time_share>},
    Figure{"rests.op_travel", "share of op's travel while pv rests", Scale::share,
           rests_figure<&loop::Rests::op_travel_share>},
    Figure{"rests.op_kurtosis", "kurtosis of op's moves within the cycle, 1 triangle, 1.5 sine",
           Scale::plain, rests_figure<&loop::Rests::op_move_kurtosis>},
    Figure{"op.rest", "time of op at rest at an end of its travel", Scale::share,
           op_rest<&loop::OpRest::share>},
    Figure{"op.rest_visits", "rests of op at the same end of its travel", Scale::plain,
           op_rest<&loop::OpRest::visits>},
};

}  // namespace

std::span<const Figure> shape_figures() {
  return kShapeFigures;
}

}  // namespace loopscope::core::diagnosis
