#include "core/plant/shared_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/plant/cascade.hpp"
#include "core/plant/event.hpp"
#include "core/plant/event_statement.hpp"
#include "core/plant/following.hpp"
#include "core/plant/lead.hpp"
#include "core/plant/roles.hpp"
#include "core/plant/source_ranking.hpp"

namespace loopscope::core::plant {
namespace {

void check(const MemberLoop& loop) {
  if (!(loop.sample_interval_s > 0.0 && std::isfinite(loop.sample_interval_s)))
    throw std::invalid_argument("a sample interval is not positive");
  if (!(loop.longer.sample_interval_s > 0.0 && std::isfinite(loop.longer.sample_interval_s)))
    throw std::invalid_argument("the interval of a longer record is not positive");
  for (const std::span<const double> series : {loop.sp, loop.pv, loop.op})
    if (!series.empty() && series.size() != loop.error.size())
      throw std::invalid_argument("a loop's series differ in length");
}

void check(const PlantSettings& settings) {
  for (const double share : {settings.event_p, settings.member_rate, settings.least_source,
                             settings.own_fault_confidence})
    if (!(share >= 0.0 && share <= 1.0))
      throw std::invalid_argument("a plant setting is not within 0 to 1");
}

void check(std::span<const MemberLoop> loops, const PlantSettings& settings) {
  check(settings);
  for (const MemberLoop& loop : loops) check(loop);
}

/// The strongest members first: as many as can be compared pair by pair.
std::vector<Lead> leads_of(const Event& event, std::span<const MemberLoop> loops) {
  std::vector<EventMember> members = event.members;
  std::ranges::stable_sort(members, std::ranges::greater(), &EventMember::strength);
  std::vector<std::size_t> indices;
  for (const EventMember& one : members) indices.push_back(one.index);
  return find_leads(loops, indices, 1.0 / event.frequency_hz);
}

void rank(SharedOscillation& result, const Event& event, std::span<const MemberLoop> loops,
          std::span<const CascadePair> cascades) {
  const auto evidence = gather_source_evidence(loops, event, cascades, result.leads);
  const SourceOdds odds = rank_sources(evidence);
  result.outside = odds.outside;
  for (std::size_t k = 0; k < evidence.size(); ++k)
    result.ranking.push_back({event.members[k].index, loops[event.members[k].index].id,
                              odds.members[k], reasons_of(evidence[k])});
  std::ranges::stable_sort(result.ranking, std::ranges::greater(), &SourceCandidate::score);
}

/// How much later than `first` the fundamental comes, within half a period.
double lag_s(const MemberLoop& loop, const MemberLoop& first, double frequency_hz) {
  const Following found =
      follow(make_envelope(loop, frequency_hz), make_envelope(first, frequency_hz));
  if (!(found.followed > 0.0)) return 0.0;
  return -std::arg(found.gain) / (2.0 * std::numbers::pi * frequency_hz);
}

SharedOscillation describe(const Event& found, std::span<const MemberLoop> loops,
                           std::span<const CascadePair> cascades, const PlantSettings& settings) {
  SharedOscillation event;
  event.period_s = 1.0 / found.frequency_hz;
  event.p = found.p;
  event.leads = leads_of(found, loops);
  rank(event, found, loops, cascades);
  const SourceCandidate& first = event.ranking.front();
  if (first.score >= settings.least_source) event.source = first.index;
  for (const EventMember& one : found.members) {
    SharingLoop member{one.index, loops[one.index].id, Role::victim, one.strength, 0.0, one.p, 0.0};
    member.lag_s = lag_s(loops[one.index], loops[first.index], found.frequency_hz);
    member.score = std::ranges::find(event.ranking, one.index, &SourceCandidate::index)->score;
    event.members.push_back(member);
  }
  assign_roles(event, loops, cascades, settings);
  std::ranges::stable_sort(event.members, std::ranges::greater(), [](const SharingLoop& member) {
    return std::pair(member.role == Role::source, member.strength);
  });
  event.statement = statement_of(event, loops);
  return event;
}

}  // namespace

std::vector<SharedOscillation> find_shared_oscillations(std::span<const MemberLoop> loops,
                                                        const PlantSettings& settings) {
  check(loops, settings);
  const std::vector<Event> events = find_events(loops, settings);
  if (events.empty()) return {};
  return explain_events(events, loops, find_cascade_pairs(loops), settings);
}

std::vector<SharedOscillation> explain_events(std::span<const Event> events,
                                              std::span<const MemberLoop> loops,
                                              std::span<const CascadePair> cascades,
                                              const PlantSettings& settings) {
  check(loops, settings);
  std::vector<SharedOscillation> result;
  for (const Event& event : events) result.push_back(describe(event, loops, cascades, settings));
  return result;
}

}  // namespace loopscope::core::plant
