#include "core/diagnosis/valve_pattern.hpp"

#include <algorithm>
#include <optional>

#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Kind = ValvePattern::Kind;

/// Positioners hold half a percent; twice that is more than their tolerance.
constexpr double kFaultyWidthPercent = 1.0;
constexpr double kGoodWidthPercent = 0.5;
/// Stickband S = width + jump. With J / S below a fifth a sticking valve is a dead band in effect.
constexpr double kSlipShare = 0.2;

/// Limits of He, Wang, Pottmann and Qin (2007) and of Horch (1999), see the notes in README.md.
constexpr double kSineShape = 0.4;
constexpr double kTriangleShape = 0.6;
constexpr double kOddDtau = 2.0 / 3.0;
constexpr double kOddDrho = 1.0 / 3.0;
constexpr double kEvenDtau = 1.0 / 3.0;
constexpr double kEvenDrho = 0.072;
constexpr double kConclusiveEllipse = 0.5;
constexpr double kWideEllipsePercent = 25.0;

/// Votes needed before the valve is accused from shapes alone.
constexpr double kAccusedScore = 0.6;
/// The cross-correlation alone accuses nobody: it is odd for an outside sinusoid and for a tightly
/// tuned loop as well (paper, section 5.3). The wave shape has to have been measured.
constexpr double kFewestWeights = 2.0;

struct Vote {
  double weight = 1.0;
  double score = 0.0;  ///< 0 speaks against stiction, 1 for it
  std::string reason;
};

std::optional<Vote> shape_vote(const loop::Shape& shape) {
  if (!shape.shape_index) return std::nullopt;
  const double score =
      std::clamp((*shape.shape_index - kSineShape) / (kTriangleShape - kSineShape), 0.0, 1.0);
  // The shape index counts twice: of the three it alone does not depend on the controller's phase.
  return Vote{2.0, score,
              "Wave shape index " + number(*shape.shape_index) +
                  " (0.6 and more is triangular, 0.4 and less sinusoidal)."};
}

std::optional<Vote> correlation_vote(const Evidence& evidence) {
  const loop::Shape& shape = evidence.shape;
  if (evidence.integrating || !shape.horch_dtau || !shape.horch_drho) return std::nullopt;
  double score = 0.5;
  if (*shape.horch_dtau > kOddDtau && *shape.horch_drho > kOddDrho) score = 1.0;
  if (*shape.horch_dtau <= kEvenDtau && *shape.horch_drho <= kEvenDrho) score = 0.0;
  return Vote{1.0, score,
              "Cross-correlation of op and pv: dtau " + number(*shape.horch_dtau) + ", drho " +
                  number(*shape.horch_drho) + " (odd, so for stiction, above 0.67 and 0.33)."};
}

std::optional<Vote> ellipse_vote(const loop::Shape& shape) {
  if (!shape.ellipse_stiction || shape.ellipse_r2.value_or(0.0) < kConclusiveEllipse) {
    return std::nullopt;
  }
  return Vote{1.0, std::clamp(*shape.ellipse_stiction / (2.0 * kWideEllipsePercent), 0.0, 1.0),
              "The pv-op plot is " + number(*shape.ellipse_stiction) + " % of the op span wide."};
}

ValvePattern judge_position(const loop::Shape& shape) {
  ValvePattern pattern;
  pattern.measured = true;
  const double width = *shape.mv_op_width;
  const double jump = shape.mv_slip_jump.value_or(0.0);
  const double stuck = shape.mv_stuck_fraction.value_or(0.0);
  if (width + jump >= kFaultyWidthPercent) {
    pattern.kind = jump >= kSlipShare * (width + jump) ? Kind::sticks : Kind::dead_band;
  } else if (width <= kGoodWidthPercent) {
    pattern.kind = Kind::follows;
  }
  pattern.reasons.push_back("The mv-op plot is " + number(width) + " % wide, mv jumps by " +
                            number(jump) + " % when it leaves rest; it stands still in " +
                            percent(stuck) + " of the samples in which op moves.");
  return pattern;
}

ValvePattern count_votes(const std::vector<std::optional<Vote>>& votes) {
  ValvePattern pattern;
  double weights = 0.0;
  for (const std::optional<Vote>& vote : votes) {
    if (!vote) continue;
    weights += vote->weight;
    pattern.score += vote->weight * vote->score;
    pattern.reasons.push_back(vote->reason);
  }
  if (weights > 0.0) pattern.score /= weights;
  if (weights >= kFewestWeights && pattern.score >= kAccusedScore) pattern.kind = Kind::sticks;
  return pattern;
}

}  // namespace

ValvePattern judge_valve(const Evidence& evidence) {
  if (evidence.shape.mv_op_width) return judge_position(evidence.shape);
  if (!evidence.oscillation.present) return {};
  return count_votes(
      {shape_vote(evidence.shape), correlation_vote(evidence), ellipse_vote(evidence.shape)});
}

}  // namespace loopscope::core::diagnosis
