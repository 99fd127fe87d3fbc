#include "daemon/calibrate/cost.hpp"

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

}  // namespace loopscope::daemon
