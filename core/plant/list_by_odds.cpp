#include "core/plant/list_by_odds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <stdexcept>

namespace loopscope::core::plant {

std::vector<bool> list_by_odds(std::span<const double> fault_probability, double share,
                               double least) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!is_share(share) || !is_share(least))
    throw std::invalid_argument("the share or the least probability is not within 0 to 1");
  std::vector<double> sorted;
  std::ranges::copy_if(fault_probability, std::back_inserter(sorted),
                       [](double value) { return !std::isnan(value); });
  if (!std::ranges::all_of(sorted, is_share))
    throw std::invalid_argument("a probability is not within 0 to 1");
  std::ranges::sort(sorted, std::greater{});
  double lowest = 2.0;  // none is as probable
  double doubt = 0.0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    doubt += 1.0 - sorted[k];
    const bool last_of_equals = k + 1 == sorted.size() || sorted[k + 1] < sorted[k];
    const bool is_within = doubt <= share * static_cast<double>(k + 1);
    if (last_of_equals && is_within && sorted[k] >= least) lowest = sorted[k];
  }
  std::vector<bool> listed;
  for (const double value : fault_probability) listed.push_back(value >= lowest);
  return listed;
}

}  // namespace loopscope::core::plant
