#include "core/plant/false_discovery.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace loopscope::core::plant {
namespace {

void check(std::span<const double> p, double rate) {
  if (!(rate >= 0.0 && rate <= 1.0)) throw std::invalid_argument("rate is not within 0 to 1");
  const bool valid = std::ranges::all_of(
      p, [](double value) { return std::isnan(value) || (value >= 0.0 && value <= 1.0); });
  if (!valid) throw std::invalid_argument("a p-value is not within 0 to 1");
}

std::vector<double> sorted_tests(std::span<const double> p) {
  std::vector<double> tests;
  std::ranges::copy_if(p, std::back_inserter(tests), [](double value) { return value >= 0.0; });
  std::ranges::sort(tests);
  return tests;
}

/// c of the bound.
double correction(std::size_t tests, Dependence dependence) {
  if (dependence == Dependence::positive) return 1.0;
  double sum = 0.0;
  for (std::size_t i = tests; i >= 1; --i) sum += 1.0 / static_cast<double>(i);
  return sum;
}

}  // namespace

FalseDiscovery control_false_discovery(std::span<const double> p, double rate,
                                       Dependence dependence) {
  check(p, rate);
  const std::vector<double> tests = sorted_tests(p);
  const double scaled = static_cast<double>(tests.size()) * correction(tests.size(), dependence);
  FalseDiscovery result{std::numeric_limits<double>::quiet_NaN(), {}};
  for (std::size_t i = tests.size(); i >= 1; --i) {
    if (tests[i - 1] > rate * static_cast<double>(i) / scaled) continue;
    result.threshold = tests[i - 1];
    break;
  }
  result.flagged.reserve(p.size());
  for (const double value : p) result.flagged.push_back(value <= result.threshold);
  return result;
}

}  // namespace loopscope::core::plant
