#include "tests/plants/process/judged_plant.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/plant/shared_oscillation.hpp"
#include "tests/plants/process/evidence_lines.hpp"
#include "tests/plants/process/names.hpp"

namespace loopscope::tests::process {
namespace {

using core::plant::MemberLoop;
using core::plant::SharedOscillation;
using core::plant::SharingLoop;

constexpr double kUntouched = 0.02;

/// A loop as the service knows it: its window made ready, and what its own diagnosis says.
struct DiagnosedLoop {
  core::FirstLook first;
  core::plant::OwnFindings own;
};

core::signal::LoopWindow window_of(const ProcessLoop& loop) {
  core::signal::LoopWindow window;
  window.sample_interval_s = loop.interval_s;
  window.start_us = std::llround(loop.start_s * 1e6);
  window.sp = loop.sp;
  window.pv = loop.pv;
  window.op = loop.op;
  return window;
}

DiagnosedLoop diagnose(const ProcessLoop& loop, std::uint64_t seed) {
  core::AnalysisSettings settings;
  settings.prepare.window_samples = loop.pv.size();
  const core::LoopFacts facts{.integrating = loop.integrating, .seed = seed};
  DiagnosedLoop result{core::first_look(window_of(loop), settings), {}};
  const auto [evidence, verdict, traces] =
      core::diagnose(result.first, settings, facts, nullptr,
                     {.cause = core::ModelTrigger{}, .traces = false, .done = {}});
  result.own = core::diagnosis::own_findings(verdict);
  return result;
}

MemberLoop member_of(const ProcessLoop& loop, const DiagnosedLoop& diagnosed) {
  MemberLoop member;
  member.name = loop.name;
  member.sample_interval_s = loop.interval_s;
  member.start_us = std::llround(loop.start_s * 1e6);
  member.error = diagnosed.first.loop.error;
  member.sp = loop.sp;
  member.pv = diagnosed.first.loop.pv;
  member.op = diagnosed.first.loop.op_percent;
  member.own = diagnosed.own;
  return member;
}

std::size_t carriers_in(const SharedOscillation& event, const ProcessPlant& plant) {
  return static_cast<std::size_t>(std::ranges::count_if(
      event.members, [&](const SharingLoop& m) { return plant.loops[m.index].carries; }));
}

const SharedOscillation* event_of_cause(const std::vector<SharedOscillation>& events,
                                        const ProcessPlant& plant) {
  const SharedOscillation* best = nullptr;
  std::size_t most = 0;
  for (const SharedOscillation& event : events)
    if (const std::size_t carriers = carriers_in(event, plant); carriers > most)
      most = carriers, best = &event;
  return best;
}

void judge_source(const SharedOscillation& event, const ProcessPlant& plant, Judgement& result) {
  const auto& first = event.ranking.front();
  result.source_first = plant.source && first.index == *plant.source;
  result.named = event.source.has_value();
  result.named_right = result.named && event.source == plant.source;
  const bool outside = event.outside > first.score;
  result.first_odds = std::max(event.outside, first.score);
  const bool source_inside =
      plant.source && std::ranges::count(event.members, *plant.source, &SharingLoop::index) > 0;
  result.first_right = outside ? !source_inside : result.source_first;
}

}  // namespace

Judgement judge_plant(PlantKind kind, Cause cause, std::uint64_t seed) {
  const ProcessPlant plant = draw_process_plant(kind, cause, seed);
  std::vector<DiagnosedLoop> diagnosed;
  for (std::size_t i = 0; i < plant.loops.size(); ++i)
    diagnosed.push_back(diagnose(plant.loops[i], seed * 100 + i));
  std::vector<MemberLoop> members;
  for (std::size_t i = 0; i < plant.loops.size(); ++i)
    members.push_back(member_of(plant.loops[i], diagnosed[i]));
  const std::vector<SharedOscillation> events = core::plant::find_shared_oscillations(members);
  Judgement result;
  result.cause = cause;
  result.events = events.size();
  result.carriers =
      static_cast<std::size_t>(std::ranges::count_if(plant.loops, &ProcessLoop::carries));
  const SharedOscillation* const event = event_of_cause(events, plant);
  if (event == nullptr) return result;
  result.found = true;
  result.carriers_found = carriers_in(*event, plant);
  result.members = event->members.size();
  result.untouched =
      static_cast<std::size_t>(std::ranges::count_if(event->members, [&](const SharingLoop& m) {
        return plant.loops[m.index].share < kUntouched;
      }));
  judge_source(*event, plant, result);
  const std::string plant_name = name_of(kind) + "_" + name_of(cause) + "_" + std::to_string(seed);
  result.evidence = evidence_lines(plant_name, *event, members, plant.source);
  return result;
}

}  // namespace loopscope::tests::process
