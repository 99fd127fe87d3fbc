#include "core/plant/hub.hpp"

#include <algorithm>
#include <utility>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::plant {

Hub find_hub(std::size_t centre, std::vector<Neighbour> around) {
  std::ranges::sort(around, {}, [](const Neighbour& n) { return std::pair(n.p, n.index); });
  Hub hub{centre, {}, 1.0};
  std::size_t size = 0;
  const auto sizes = static_cast<double>(around.size());
  for (std::size_t k = 1; k <= around.size(); ++k) {
    // Not rarer than expected: no hub, and most of many loops are spared the sum.
    if (around[k - 1].p * sizes >= static_cast<double>(k)) continue;
    const double p = hos::binomial_at_least(k, around.size(), around[k - 1].p) * sizes;
    if (p < hub.p) hub.p = p, size = k;
  }
  for (std::size_t k = 0; k < size; ++k) hub.neighbours.push_back(around[k].index);
  return hub;
}

}  // namespace loopscope::core::plant
