#include "tests/plants/network/outcome.hpp"

#include <algorithm>
#include <chrono>

#include "core/plant/cascade.hpp"
#include "tests/plants/network/criteria.hpp"

namespace loopscope::tests::network {
namespace {

using core::plant::SharedOscillation;
using core::plant::SharingLoop;

std::size_t carriers_in(const SharedOscillation& event, const NetworkPlant& plant) {
  return static_cast<std::size_t>(std::ranges::count_if(
      event.members, [&](const SharingLoop& m) { return plant.loops[m.index].carries; }));
}

/// The event of the cause: the one with most of its carriers; nullptr = none has one.
const SharedOscillation* event_of_cause(const std::vector<SharedOscillation>& events,
                                        const NetworkPlant& plant) {
  const SharedOscillation* best = nullptr;
  for (const SharedOscillation& event : events)
    if (carriers_in(event, plant) > (best == nullptr ? 0 : carriers_in(*best, plant)))
      best = &event;
  return best;
}

void judge_members(const SharedOscillation& event, const NetworkPlant& plant, Outcome& outcome) {
  outcome.members = event.members.size();
  outcome.carriers_found = carriers_in(event, plant);
  for (const SharingLoop& member : event.members) {
    const TrueLoop& loop = plant.loops[member.index];
    if (loop.share < kUntouched) ++outcome.untouched;
    const bool victim = loop.carries && !loop.unrelated && member.index != plant.source;
    if (victim && !leaves_work_list(member.role)) ++outcome.victims_listed;
    if (loop.sticks) ++outcome.own_valves;
    if (loop.sticks && leaves_work_list(member.role)) ++outcome.own_valves_hidden;
  }
}

void judge_source(const SharedOscillation& event, const NetworkPlant& plant, Outcome& outcome) {
  if (event.source) outcome.named = plant.loops[*event.source].name;
  const auto& ranking = event.ranking;
  const auto place = std::ranges::find_if(
      ranking, [&](const auto& candidate) { return candidate.index == plant.source; });
  if (place != ranking.end()) outcome.rank = static_cast<std::size_t>(place - ranking.begin()) + 1;
}

using Pairs = std::vector<core::plant::CascadePair>;

void judge_cascades(const Pairs& pairs, const NetworkPlant& plant, Outcome& outcome) {
  outcome.cascades = plant.cascades.size();
  for (const auto& pair : pairs) {
    const bool real = std::ranges::count(plant.cascades, std::pair(pair.master, pair.slave)) > 0;
    ++(real ? outcome.cascades_found : outcome.cascades_false);
  }
}

std::vector<core::plant::SourceEvidence> evidence_of(
    const SharedOscillation& event, const std::vector<core::plant::MemberLoop>& members,
    const Pairs& pairs) {
  core::plant::Event found{1.0 / event.period_s, event.p, {}};
  for (const SharingLoop& member : event.members)
    found.members.push_back({member.index, member.p, member.strength});
  return core::plant::gather_source_evidence(members, found, pairs, event.leads);
}

void note_figures(const SharedOscillation& event,
                  const std::vector<core::plant::SourceEvidence>& evidence,
                  const NetworkPlant& plant, Outcome& outcome) {
  const core::plant::SourceFigures figures = core::plant::figures_of(evidence);
  for (std::size_t k = 0; k < event.members.size(); ++k)
    outcome.figures.push_back({event.members[k].index == plant.source, figures.members[k]});
  outcome.none = figures.none;
}

std::vector<double> first_by_criterion(const SharedOscillation& event,
                                       const std::vector<core::plant::SourceEvidence>& evidence,
                                       const std::vector<DiagnosedLoop>& loops,
                                       std::size_t source) {
  std::vector<Criteria> values;
  std::size_t own = event.members.size();
  for (std::size_t k = 0; k < event.members.size(); ++k) {
    const SharingLoop& member = event.members[k];
    if (member.index == source) own = k;
    values.push_back(measure_criteria(loops[member.index], event.period_s, member, evidence[k]));
  }
  std::vector<double> first(criterion_names().size(), 0.0);
  if (own == values.size()) return first;
  for (std::size_t c = 0; c < first.size(); ++c) {
    const auto value = [c](const Criteria& criteria) { return criteria[c]; };
    if (std::ranges::max(values, {}, value)[c] > values[own][c]) continue;
    first[c] = 1.0 / static_cast<double>(std::ranges::count(values, values[own][c], value));
  }
  return first;
}

}  // namespace

Outcome run_plant(std::uint64_t seed, Origin origin, Extras extras) {
  using Clock = std::chrono::steady_clock;
  const NetworkPlant plant = draw_network(seed, origin);
  std::vector<DiagnosedLoop> loops;
  for (std::size_t i = 0; i < plant.records.size(); ++i)
    loops.push_back(diagnose(plant.records[i], plant.loops[i], seed * 100 + i));
  const std::vector<core::plant::MemberLoop> members = members_of(loops);
  const auto start = Clock::now();
  const std::vector<SharedOscillation> events = core::plant::find_shared_oscillations(members);
  const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
  Outcome outcome;
  outcome.seed = seed;
  outcome.origin = origin;
  outcome.plant_ms = taken.count();
  outcome.events = events.size();
  if (plant.source) outcome.source = plant.loops[*plant.source].name;
  outcome.carriers =
      static_cast<std::size_t>(std::ranges::count_if(plant.loops, &TrueLoop::carries));
  const Pairs pairs = core::plant::find_cascade_pairs(members);
  judge_cascades(pairs, plant, outcome);
  const SharedOscillation* const event = event_of_cause(events, plant);
  if (event == nullptr) return outcome;
  outcome.found = true;
  judge_members(*event, plant, outcome);
  judge_source(*event, plant, outcome);
  if (!extras.figures && !extras.criteria) return outcome;
  const auto evidence = evidence_of(*event, members, pairs);
  if (extras.figures) note_figures(*event, evidence, plant, outcome);
  if (extras.criteria && plant.source)
    outcome.by_criterion = first_by_criterion(*event, evidence, loops, *plant.source);
  return outcome;
}

}  // namespace loopscope::tests::network
