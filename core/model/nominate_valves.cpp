#include "core/model/effects/valve.hpp"
#include "core/model/nominate.hpp"
#include "core/model/valve_search.hpp"

namespace loopscope::core::model {
namespace {

EffectPtr effect_of(const ValveCandidate& candidate) {
  return std::make_shared<ValveEffect>(candidate.valve, candidate.restarts);
}

}  // namespace

std::vector<EffectPtr> nominate_valves(const LoopData& data, const Fit&) {
  std::vector<std::uint8_t> seen(data.size(), 0);
  for (const Range& range : data.rows.fit) {
    for (std::size_t k = range.first; k < range.end; ++k) seen[k] = 1;
  }
  const ValveSearchResult found = search_valve({data.pv, data.op, seen});
  std::vector<EffectPtr> result;
  for (const ValveCandidate& candidate : found.candidates) result.push_back(effect_of(candidate));
  if (found.deadband) result.push_back(effect_of(*found.deadband));
  return result;
}

}  // namespace loopscope::core::model
