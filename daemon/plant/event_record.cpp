#include "daemon/plant/event_record.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/plant/event_picture.hpp"

namespace loopscope::daemon {
namespace {

using Loops = std::span<const core::plant::MemberLoop>;
using core::plant::SharedOscillation;

std::vector<std::string> reasons_for(const SharedOscillation& event, std::size_t index) {
  const auto found = std::ranges::find(event.ranking, index, &core::plant::SourceCandidate::index);
  return found == event.ranking.end() ? std::vector<std::string>() : found->reasons;
}

std::vector<storage::PlantLead> leads_between(const SharedOscillation& event, Loops loops) {
  std::vector<storage::PlantLead> leads;
  for (const core::plant::Lead& lead : event.leads)
    leads.push_back({loops[lead.from].id, loops[lead.to].id, lead.gain, lead.direct});
  return leads;
}

/// The source is drawn whatever its share: everybody else is compared with it.
std::vector<std::size_t> drawn_first(const SharedOscillation& event) {
  std::vector<core::plant::SharingLoop> members = event.members;
  std::ranges::stable_sort(
      members, std::ranges::greater(), [](const core::plant::SharingLoop& member) {
        return std::pair(member.role == core::plant::Role::source, member.strength);
      });
  std::vector<std::size_t> indices;
  for (const core::plant::SharingLoop& member : members) indices.push_back(member.index);
  return indices;
}

std::vector<storage::PlantTrace> traces_of(const SharedOscillation& event, Loops loops) {
  std::vector<storage::PlantTrace> traces;
  for (auto& drawn : core::plant::picture_event(event.period_s, drawn_first(event), loops))
    traces.push_back({loops[drawn.index].id, drawn.start_us, drawn.step_s, std::move(drawn.error),
                      std::move(drawn.periods_s), std::move(drawn.power)});
  return traces;
}

}  // namespace

storage::PlantEvent event_record(const SharedOscillation& event, Loops loops) {
  storage::PlantEvent record;
  record.period_s = event.period_s;
  if (event.source) record.source_loop_id = loops[*event.source].id;
  record.statement = event.statement;
  record.p = event.p;
  record.outside = event.outside;
  for (const core::plant::SharingLoop& member : event.members)
    record.members.push_back({member.id, std::string(core::plant::name(member.role)),
                              member.strength, member.lag_s, member.score,
                              reasons_for(event, member.index)});
  record.leads = leads_between(event, loops);
  record.traces = traces_of(event, loops);
  return record;
}

}  // namespace loopscope::daemon
