#include "core/plant/roles.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace loopscope::core::plant {
namespace {

/// A loop that the oscillation shakes less has other reasons for its verdict.
constexpr double kVictimStrength = 0.2;
/// From here on most of what the loop does is the oscillation, and so is what its verdict rests on.
constexpr double kOwnCycleStrength = 0.5;
/// As likely the source as this, a member is not excused by another one.
constexpr double kLikelySource = 0.2;

bool blames_equipment(Fault fault) {
  return fault == Fault::friction || fault == Fault::valve || fault == Fault::sensor ||
         fault == Fault::process;
}

/// With a source the others shake because it does. Where none is named, a badly tuned loop may well
/// be what shakes them.
bool accounts_for(Fault fault, const SharedOscillation& event) {
  return blames_equipment(fault) || (fault == Fault::tuning && !event.source);
}

/// A wave that a sticking valve makes has the shape of friction wherever it arrives: a loop that
/// another one shakes looks, seen alone, as if its own valve stuck.
bool borrowed(const SharingLoop& member, const MemberLoop& loop, const SharedOscillation& event) {
  return event.source && loop.own.fault == Fault::friction &&
         member.strength >= kOwnCycleStrength && member.score < kLikelySource;
}

/// A fault of its own that the loop's verdict is sure of.
bool keeps_its_place(const SharingLoop& member, const MemberLoop& loop,
                     const SharedOscillation& event, const PlantSettings& settings) {
  if (member.strength < kVictimStrength) return true;
  return accounts_for(loop.own.fault, event) &&
         loop.own.confidence >= settings.own_fault_confidence && !borrowed(member, loop, event);
}

SharingLoop* find(SharedOscillation& event, std::size_t index) {
  const auto found = std::ranges::find(event.members, index, &SharingLoop::index);
  return found == event.members.end() ? nullptr : &*found;
}

void mark_cascade(SharedOscillation& event, const CascadePair& pair) {
  SharingLoop* const master = find(event, pair.master);
  SharingLoop* const slave = find(event, pair.slave);
  if (master == nullptr || slave == nullptr) return;
  if (master->role == Role::victim) master->role = Role::cascade_master;
  if (slave->role == Role::victim) slave->role = Role::cascade_slave;
}

}  // namespace

std::string_view name(Role role) {
  constexpr std::array<std::string_view, 5> kNames = {"source", "victim", "cascade_master",
                                                      "cascade_slave", "member"};
  return kNames.at(static_cast<std::size_t>(role));
}

bool leaves_work_list(Role role) {
  return role == Role::victim || role == Role::cascade_master || role == Role::cascade_slave;
}

void assign_roles(SharedOscillation& event, std::span<const MemberLoop> loops,
                  std::span<const CascadePair> cascades, const PlantSettings& settings) {
  for (SharingLoop& member : event.members) {
    const bool is_source = event.source && *event.source == member.index;
    member.role = is_source                                                       ? Role::source
                  : keeps_its_place(member, loops[member.index], event, settings) ? Role::member
                                                                                  : Role::victim;
  }
  for (const CascadePair& pair : cascades) mark_cascade(event, pair);
}

}  // namespace loopscope::core::plant
