#include "core/diagnosis/evidence/shape_figures.hpp"

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

template <auto member>
Value cycle_figure(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  return evidence.cycle->evidence.*member;
}

Value cycle_odds(const Evidence& evidence) {
  if (!evidence.cycle) return std::nullopt;
  constexpr double kLeast = 1e-4;
  const double score = std::clamp(evidence.cycle->score, kLeast, 1.0 - kLeast);
  return std::log(score / (1.0 - score));
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
Value plateau_figure(const Evidence& evidence) {
  if (!evidence.pv_plateaus) return std::nullopt;
  return (*evidence.pv_plateaus).*member;
}

template <auto member>
Value op_at_ends(const Evidence& evidence) {
  if (!evidence.op_at_ends) return std::nullopt;
  return (*evidence.op_at_ends).*member;
}

constexpr std::array kShapeFigures = {
    Figure{"shape.index", "wave shape index, 0 sine, 1 triangle", Scale::plain,
           shape_figure<&loop::Shape::shape_index>},
    Figure{"position.width", "width of the recorded mv-op plot, %", Scale::plain,
           shape_figure<&loop::Shape::mv_op_width>},
    Figure{"position.jump", "jump of the recorded valve position when it leaves rest, %",
           Scale::plain, shape_figure<&loop::Shape::mv_slip_jump>},
    Figure{"position.stuck", "time in which the recorded valve position stands while op moves",
           Scale::share, shape_figure<&loop::Shape::mv_stuck_fraction>},
    Figure{"cycle.odds", "log odds of a sticking valve by the shape of the cycle", Scale::plain,
           cycle_odds},
    Figure{"cycle.op_coherence", "op repeats its half cycle", Scale::share,
           cycle_figure<&model::CycleEvidence::op_coherence>},
    Figure{"cycle.linear_error", "error of the cycle that a linear process leaves", Scale::share,
           cycle_figure<&model::CycleEvidence::error_before>},
    Figure{"cycle.pace", "larger half cycles of the error last longer (-1: shorter)", Scale::plain,
           cycle_figure<&model::CycleEvidence::pace>},
    Figure{"travel.gain", "error of op's slow travel that a sticking valve takes away",
           Scale::share, travel_gain<&Evidence::travel>},
    Figure{"travel.cycle_gain",
           "error of op's travel in a slow cycle that a sticking valve takes away", Scale::share,
           travel_gain<&Evidence::cycle_travel>},
    Figure{"travel.linear", "share of pv that follows op's slow travel", Scale::share,
           travel_figure<&model::SlowTravel::linear_share>},
    Figure{"rests.kurtosis", "kurtosis of pv's moves within the cycle, 1.5 sine", Scale::plain,
           plateau_figure<&loop::PvPlateaus::move_kurtosis>},
    Figure{"rests.time", "time in which pv rests within the cycle", Scale::share,
           plateau_figure<&loop::PvPlateaus::time_share>},
    Figure{"rests.op_travel", "share of op's travel while pv rests", Scale::share,
           plateau_figure<&loop::PvPlateaus::op_travel_share>},
    Figure{"op.rest", "time of op at rest at an end of its travel", Scale::share,
           op_at_ends<&loop::OpAtEnds::share>},
    Figure{"op.rest_visits", "rests of op at the same end of its travel", Scale::plain,
           op_at_ends<&loop::OpAtEnds::visits>},
};

}  // namespace

std::span<const Figure> shape_figures() {
  return kShapeFigures;
}

}  // namespace loopscope::core::diagnosis
