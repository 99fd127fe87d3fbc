#include "daemon/calibrate/false_discovery.hpp"

#include <algorithm>
#include <iterator>

namespace loopscope::daemon {
namespace {

double threshold_of(std::vector<double> tested, double rate) {
  std::ranges::sort(tested);
  for (std::size_t rank = tested.size(); rank > 0; --rank) {
    const double allowed = rate * static_cast<double>(rank) / static_cast<double>(tested.size());
    if (tested[rank - 1] <= allowed) return tested[rank - 1];
  }
  return -1.0;
}

}  // namespace

FalseDiscovery control_false_discovery(std::span<const double> p, double rate) {
  std::vector<double> tested;
  std::ranges::copy_if(p, std::back_inserter(tested), [](double value) { return value >= 0.0; });
  const double threshold = threshold_of(std::move(tested), rate);
  FalseDiscovery result;
  result.threshold = std::max(0.0, threshold);
  for (const double value : p) result.flagged.push_back(value <= threshold);
  return result;
}

}  // namespace loopscope::daemon
