#include "core/signal/order/order_statistic.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/signal/order/bands.hpp"

namespace loopscope::core::signal {
namespace {

/// Fewer are done with by comparisons at once.
constexpr std::size_t kFewestForBands = 100;
/// So that a band holds a handful of a window's values.
constexpr std::size_t kBands = 1024;

double select(std::vector<double> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

double order_statistic(std::span<const double> values, std::size_t rank) {
  const Bands bands(values, kBands);
  if (values.size() < kFewestForBands || !bands.usable()) {
    return select({values.begin(), values.end()}, rank);
  }
  std::array<std::uint32_t, kBands> counts{};
  for (const double value : values) ++counts[bands.of(value)];
  std::size_t below = 0;
  std::size_t band = 0;
  while (below + counts[band] <= rank) below += counts[band++];
  std::vector<double> inside;
  inside.reserve(counts[band]);
  for (const double value : values) {
    if (bands.of(value) == band) inside.push_back(value);
  }
  return select(std::move(inside), rank - below);
}

double median(std::span<const double> values) {
  return order_statistic(values, values.size() / 2);
}

}  // namespace loopscope::core::signal
