#include "core/model/nominate_valves.hpp"

#include <algorithm>

#include "core/model/effects/valve.hpp"
#include "core/model/valve_search.hpp"

namespace loopscope::core::model {
namespace {

template <typename Keep>
std::vector<ValveRestart> kept(const std::vector<ValveRestart>& restarts, const Keep& keep) {
  std::vector<ValveRestart> result;
  std::ranges::copy_if(restarts, std::back_inserter(result), keep);
  return result;
}

/// By its law from a start that was put right, and put right wherever a fit may look.
void add(const ValveCandidate& candidate, const std::vector<std::uint8_t>& seen,
         std::vector<EffectPtr>& effects) {
  const auto at_start = [](const ValveRestart& restart) {
    return restart.at_sample < ValveEffect::kStart;
  };
  const auto in_sight = [&](const ValveRestart& restart) {
    return at_start(restart) || (restart.at_sample < seen.size() && seen[restart.at_sample] != 0);
  };
  effects.push_back(
      std::make_shared<ValveEffect>(candidate.valve, kept(candidate.restarts, at_start)));
  if (candidate.corrections > 1) {
    effects.push_back(
        std::make_shared<ValveEffect>(candidate.valve, kept(candidate.restarts, in_sight)));
  }
}

}  // namespace

std::vector<EffectPtr> nominate_valves(const LoopData& data) {
  if (!data.grid.every_sample()) return {};
  std::vector<std::uint8_t> seen(data.size(), 0);
  for (const Range& range : data.rows.fit) {
    for (std::size_t k = range.first; k < range.end; ++k) seen[k] = 1;
  }
  std::vector<std::uint8_t> all = seen;
  for (const Range& range : data.rows.score) {
    for (std::size_t k = range.first; k < range.end; ++k) all[k] = 1;
  }
  const ValveSearchResult found = search_valve({data.pv, data.op, all});
  std::vector<EffectPtr> result;
  for (const ValveCandidate& candidate : found.candidates) add(candidate, seen, result);
  if (found.deadband) add(*found.deadband, seen, result);
  return result;
}

}  // namespace loopscope::core::model
