#include "tests/core/hos/uniformity.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos::tests {

double distance_from_uniform(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  const auto count = static_cast<double>(p.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto below = static_cast<double>(i);
    distance = std::max({distance, p[i] - below / count, (below + 1.0) / count - p[i]});
  }
  return std::sqrt(count) * distance;
}

double share_below(const std::vector<double>& p, double level) {
  const auto hits = std::count_if(p.begin(), p.end(), [level](double v) { return v <= level; });
  return static_cast<double>(hits) / static_cast<double>(p.size());
}

}  // namespace loopscope::core::hos::tests
