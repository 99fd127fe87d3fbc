#include "core/plant/hub.hpp"

#include <algorithm>
#include <utility>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::plant {

Hub find_star(std::size_t centre, std::vector<Neighbour> around) {
  std::ranges::sort(around, {}, [](const Neighbour& n) { return std::pair(n.p, n.index); });
  Hub star{centre, {}, 1.0};
  std::size_t size = 0;
  const auto sizes = static_cast<double>(around.size());
  for (std::size_t k = 1; k <= around.size(); ++k) {
    // Not rarer than expected: no star, and most of many loops are spared the sum.
    if (around[k - 1].p * sizes >= static_cast<double>(k)) continue;
    const double p = hos::binomial_at_least(k, around.size(), around[k - 1].p) * sizes;
    if (p < star.p) star.p = p, size = k;
  }
  for (std::size_t k = 0; k < size; ++k) star.rays.push_back(around[k].index);
  return star;
}

}  // namespace loopscope::core::plant
