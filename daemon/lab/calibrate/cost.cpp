#include "daemon/lab/calibrate/cost.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace loopscope::daemon {

Cost mean_cost(std::span<const FamilyTally> tallies, std::size_t records) {
  constexpr double kMicroseconds = 1e6;
  const auto count = static_cast<double>(tallies.size() * records);
  Cost cost;
  for (const FamilyTally& tally : tallies) {
    cost.estimate_us += kMicroseconds * tally.estimate_s / count;
    cost.analyse_us += kMicroseconds * tally.analyse_s / count;
  }
  return cost;
}

Cost healthy_cost(std::span<const FamilyTally> tallies, std::size_t records) {
  std::vector<FamilyTally> healthy;
  std::ranges::copy_if(tallies, std::back_inserter(healthy), [](const FamilyTally& tally) {
    return tally.family.kind == core::simulate::FamilyKind::linear_gaussian;
  });
  return mean_cost(healthy.empty() ? tallies : std::span<const FamilyTally>(healthy), records);
}

}  // namespace loopscope::daemon
