#include "daemon/report/figures/min_max_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace loopscope::daemon {
namespace {

constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();

struct Extremes {
  std::size_t low = 0;
  std::size_t high = 0;
};

std::optional<Extremes> extremes(std::span<const double> samples, std::size_t begin,
                                 std::size_t end) {
  std::optional<Extremes> found;
  for (std::size_t k = begin; k < end; ++k) {
    if (!std::isfinite(samples[k])) continue;
    if (!found) found = Extremes{k, k};
    if (samples[k] < samples[found->low]) found->low = k;
    if (samples[k] > samples[found->high]) found->high = k;
  }
  return found;
}

std::vector<Point> whole(std::span<const double> samples, double start, double step) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double y = std::isfinite(samples[k]) ? samples[k] : kBreak;
    points.push_back({start + step * static_cast<double>(k), y});
  }
  return points;
}

}  // namespace

std::vector<Point> envelope(std::span<const double> samples, double start, double step,
                            std::size_t columns) {
  if (samples.size() <= 2 * columns) return whole(samples, start, step);
  std::vector<Point> points;
  const auto at = [&](std::size_t k) {
    return Point{start + step * static_cast<double>(k), samples[k]};
  };
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t begin = column * samples.size() / columns;
    const auto found = extremes(samples, begin, (column + 1) * samples.size() / columns);
    if (!found) {
      points.push_back({start + step * static_cast<double>(begin), kBreak});
      continue;
    }
    const auto [first, last] = std::minmax(found->low, found->high);
    points.push_back(at(first));
    if (last != first) points.push_back(at(last));
  }
  return points;
}

}  // namespace loopscope::daemon
