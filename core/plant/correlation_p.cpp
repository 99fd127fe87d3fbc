#include "core/plant/correlation_p.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kFewestPairs = 8;
constexpr double kSmallest = 1e-300;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double correlation_p(std::span<const double> x, std::span<const double> y, double freedom_lost) {
  if (x.size() < kFewestPairs) return 1.0;
  const double mx = mean_of(x), my = mean_of(y);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    yy += (y[k] - my) * (y[k] - my);
    xy += (x[k] - mx) * (y[k] - my);
  }
  if (!(xx > 0.0 && yy > 0.0)) return 1.0;
  const double r = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  const double freedom = static_cast<double>(x.size()) - 2.0 - freedom_lost;
  return hos::student_upper(r * std::sqrt(freedom / (1.0 - r * r)), freedom);
}

double fisher_combined_p(std::span<const double> p) {
  double sum = 0.0;
  for (const double value : p) sum -= std::log(std::max(value, kSmallest));
  return hos::gamma_upper(sum, static_cast<double>(p.size()));
}

}  // namespace loopscope::core::plant
