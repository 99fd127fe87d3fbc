#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/plant/cascade.hpp"
#include "core/plant/event.hpp"
#include "core/plant/member_loop.hpp"
#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// What speaks for and against one member's being where a shared oscillation begins.
struct SourceEvidence {
  double strength = 0.0;         ///< share of the error's variance in the oscillation, 0 to 1
  double line_height = 1.0;      ///< of the error's line above the loop's own noise; 1 = none
  double op_share = 0.0;         ///< of the output's variance in its line, 0 to 1
  double net_lead = 0.0;         ///< lead.hpp, -1 to 1
  double direct_lead = 0.0;      ///< net, of what goes by no other member; -1 to 1
  double friction_p = 0.0;       ///< OwnFindings, a probability
  double outside_p = 0.0;        ///< OwnFindings, a probability
  double cubic_evidence = 0.0;   ///< -ln p of f + f + f -> 3f in the error, at the period
  bool writes_setpoint = false;  ///< its output is another loop's setpoint: it moves no valve
};

/// Of every member of `event`, in their order.
[[nodiscard]] std::vector<SourceEvidence> gather_source_evidence(
    std::span<const MemberLoop> loops, const Event& event, std::span<const CascadePair> cascades,
    std::span<const Lead> leads);

inline constexpr std::size_t kSourceFigures = 7;
inline constexpr std::size_t kNoneFigures = 2;

/// The evidence as the ranking weighs it.
struct SourceFigures {
  std::vector<std::array<double, kSourceFigures>> members;
  /// Of "none of them": 1 - the largest net lead; mean of ln(1 + cubic evidence) by strength, since
  /// what makes a cycle inside the plant is nonlinear and shows it to all.
  std::array<double, kNoneFigures> none{};
};
/// What speaks of a valve counts in full from a strength of a quarter on, in proportion below (a
/// valve that sticks in another rhythm is not the source), and not at all for a loop that moves
/// none.
[[nodiscard]] SourceFigures figures_of(std::span<const SourceEvidence> evidence);

/// In words, with figures, what speaks for the loop first.
[[nodiscard]] std::vector<std::string> reasons_of(const SourceEvidence& evidence);

}  // namespace loopscope::core::plant
