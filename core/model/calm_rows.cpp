#include "core/model/calm_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/signal/median.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kGross = 6.0;
/// What a jump disturbs beside itself.
constexpr std::size_t kBefore = 3;
constexpr std::size_t kAfter = 8;

double gross_limit(const Rows& rows, const std::vector<double>& innovations) {
  std::vector<double> sizes;
  for (const Range& range : rows.fit) {
    for (std::size_t k = range.first; k < range.end; ++k) sizes.push_back(std::abs(innovations[k]));
  }
  return sizes.empty() ? 0.0 : kGross * signal::kMadToSigma * signal::median(std::move(sizes));
}

void add_calm_parts(const Range& range, const std::vector<double>& innovations, double limit,
                    std::vector<Range>& calm) {
  std::size_t first = range.first;
  for (std::size_t k = range.first; k < range.end; ++k) {
    if (std::abs(innovations[k]) <= limit) continue;
    const std::size_t end = std::max(first, k < kBefore ? 0 : k - kBefore);
    if (end > first) calm.push_back({first, end});
    first = std::min(range.end, k + kAfter);
  }
  if (range.end > first) calm.push_back({first, range.end});
}

}  // namespace

Rows calm_rows(const Rows& rows, const Fit& fit) {
  const double limit = gross_limit(rows, fit.innovations);
  Rows result;
  for (const Range& range : rows.fit) add_calm_parts(range, fit.innovations, limit, result.fit);
  result.score = rows.score;
  return result;
}

}  // namespace loopscope::core::model
