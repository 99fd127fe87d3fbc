#include "core/plant/event_statement.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/text/phrases.hpp"

namespace loopscope::core::plant {
namespace {

/// More names do not help in one sentence; the list of members has them all.
constexpr std::size_t kNamed = 6;

std::string name_of(const MemberLoop& loop) {
  return loop.name.empty() ? "loop " + std::to_string(loop.id) : loop.name;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = std::min(kNamed, names.size());
  for (std::size_t k = 0; k < shown; ++k) text += (k == 0 ? "" : ", ") + names[k];
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

/// Of the members of which `chosen` holds.
template <typename Chosen>
std::string names_where(const SharedOscillation& event, std::span<const MemberLoop> loops,
                        Chosen chosen) {
  std::vector<std::string> names;
  for (const SharingLoop& member : event.members)
    if (chosen(member, loops[member.index].own.fault))
      names.push_back(name_of(loops[member.index]));
  return listed(names);
}

std::string what(const SharedOscillation& event, std::span<const MemberLoop> loops) {
  const auto all = [](const SharingLoop&, Fault) { return true; };
  return std::to_string(event.members.size()) +
         " loops take part in one oscillation with a period of " + text::duration(event.period_s) +
         ": " + names_where(event, loops, all) + ".";
}

std::string where_from(const SharedOscillation& event, std::span<const MemberLoop> loops) {
  const SourceCandidate& first = event.ranking.front();
  const std::string name = name_of(loops[first.index]);
  if (event.source)
    return " It comes from " + name + " (probability " + text::percent(first.score) + "). " +
           first.reasons.front() + " Repair " + name +
           " first; the others follow it and should stop oscillating once it is repaired.";
  if (event.outside > first.score)
    return " No member stands out as its source (most likely " + name + ", " +
           text::percent(first.score) +
           "): check what these loops have in common upstream: supplies, and loops that are not "
           "recorded.";
  return " Its source is not clear: " + name + " is the most likely member (" +
         text::percent(first.score) +
         "). If operations agrees, put its controller in manual for a few periods and " +
         "see whether the others stop oscillating.";
}

/// A member without a fault is one that the oscillation hardly touches.
std::string own_faults(const SharedOscillation& event, std::span<const MemberLoop> loops) {
  const std::string names = names_where(event, loops, [](const SharingLoop& member, Fault fault) {
    return member.role == Role::member && fault != Fault::none;
  });
  if (names.empty()) return {};
  return " With a finding of their own, and kept on the list: " + names + ".";
}

/// Victims whose own verdict blames the valve for the cycle that they share with the source.
std::string borrowed_faults(const SharedOscillation& event, std::span<const MemberLoop> loops) {
  if (!event.source) return {};
  const std::string names = names_where(event, loops, [](const SharingLoop& member, Fault fault) {
    return leaves_work_list(member.role) && fault == Fault::friction;
  });
  if (names.empty()) return {};
  return " Judged alone, a valve would be blamed for the same cycle; when the source is repaired, "
         "check these again: " +
         names + ".";
}

}  // namespace

std::string statement_of(const SharedOscillation& event, std::span<const MemberLoop> loops) {
  return what(event, loops) + where_from(event, loops) + own_faults(event, loops) +
         borrowed_faults(event, loops);
}

}  // namespace loopscope::core::plant
