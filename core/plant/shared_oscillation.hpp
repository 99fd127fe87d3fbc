#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant {

/// What a loop is in a shared oscillation.
enum class Role {
  source,          ///< named as the cause
  victim,          ///< carries the oscillation; nothing of its own is shown: leaves the work list
  cascade_master,  ///< its output is the setpoint of a member, and it passes the oscillation on
  cascade_slave,   ///< follows a member's output: leaves the work list
  member,          ///< shares it, but a fault of its own is shown: stays on the work list
};
/// The word of the results schema.
[[nodiscard]] std::string_view name(Role role);
/// Whether the loop's oscillation needs no work order of its own.
[[nodiscard]] bool leaves_work_list(Role role);

/// One loop of a shared oscillation.
struct SharingLoop {
  std::size_t index = 0;  ///< in the loops that were given
  std::int64_t id = 0;
  Role role = Role::victim;
  double strength = 0.0;  ///< share of the error's variance at the period and its harmonics, 0 to 1
  /// How much later than the source (without one: than the first of the ranking) the fundamental
  /// arrives, within half a period either way; the sign of a process gain is half a period.
  double lag_s = 0.0;
  double p = 1.0;      ///< that a loop of its own oscillation keeps step with the others so well
  double score = 0.0;  ///< probability of being the source, as in the ranking
};

/// How one member stands as the source.
struct SourceCandidate {
  std::size_t index = 0;
  std::int64_t id = 0;
  double score = 0.0;                ///< probability of being the source, 0 to 1
  std::vector<std::string> reasons;  ///< what speaks for and against it, with figures
};

/// One loop's past foretells another one's future.
struct Lead {
  std::size_t from = 0;  ///< in the loops that were given
  std::size_t to = 0;    ///< likewise
  double gain = 0.0;     ///< ln(variance without / with it) of the one-step error, >= 0
  /// The same of what no other member tells as well; 0 = nothing, or too short a record to say.
  double direct = 0.0;
};

/// One oscillation that several loops share: one event, one work order.
struct SharedOscillation {
  double period_s = 0.0;
  /// Probability that a plant of so many independent oscillating loops shows loops that keep step
  /// so well anywhere.
  double p = 1.0;
  std::vector<SharingLoop> members;      ///< the source first, then by strength; at least two
  std::vector<SourceCandidate> ranking;  ///< every member, most likely source first
  std::vector<Lead> leads;               ///< between the strongest members, strongest first
  double outside = 0.0;  ///< probability that the cause is none of the members, 0 to 1
  /// In the loops that were given; nullopt = no member stands out, or the cause lies outside.
  std::optional<std::size_t> source;
  std::string statement;  ///< for people: period, members, source, why, what to do
};

struct CascadePair;
struct Event;

/// Limits of the search.
struct PlantSettings {
  /// Largest p of an event: of so many plants of independent loops, one shows a false one.
  double event_p = 0.01;
  double member_rate = 0.05;          ///< false share of an event's further members
  double least_source = 0.5;          ///< score below which no source is named
  double own_fault_confidence = 0.6;  ///< of the verdict with which a member keeps its place
};

/// Which of `loops` share an oscillation, and where it comes from.
///
/// The plant is looked at as a whole (event.hpp): lines that the spectra of loops which go together
/// show together, faint ones too; a loop need not pass as oscillating by itself. Members are those
/// that follow the common course beyond chance, weak ones too; one that follows several belongs to
/// the event that shakes it most. Sample intervals, starts and lengths may differ; what is compared
/// is the time in common. Strongest evidence first; the same input gives the same output.
/// Throws std::invalid_argument for spans of different lengths, an interval that is not positive,
/// and settings outside 0 to 1.
[[nodiscard]] std::vector<SharedOscillation> find_shared_oscillations(
    std::span<const MemberLoop> loops, const PlantSettings& settings = {});

/// The second half of find_shared_oscillations: what find_events (event.hpp) found, explained. Only
/// members are looked at more closely, so that sp, pv and op of the others need not be there; a
/// member whose record holds too few periods has to be given with a longer one in its place.
/// `cascades` = find_cascade_pairs of the records as they were sampled. Throws as
/// find_shared_oscillations does.
[[nodiscard]] std::vector<SharedOscillation> explain_events(std::span<const Event> events,
                                                            std::span<const MemberLoop> loops,
                                                            std::span<const CascadePair> cascades,
                                                            const PlantSettings& settings = {});

}  // namespace loopscope::core::plant
