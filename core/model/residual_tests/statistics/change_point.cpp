#include "core/model/residual_tests/statistics/change_point.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/residual_tests/statistics/tails.hpp"

namespace loopscope::core::model {
namespace {

/// Near the ends the standardised distance of a bridge is large by chance.
constexpr double kMargin = 0.02;

struct ChangeSums {
  double value = 0.0;
  double square = 0.0;
  double count = 0.0;
  void add(double increment) {
    value += increment;
    square += increment * increment;
    count += increment != 0.0 ? 1.0 : 0.0;
  }
  [[nodiscard]] double mean() const { return count > 0.0 ? value / count : 0.0; }
};

ChangeSums sum_of(std::span<const double> increments) {
  ChangeSums sums;
  for (const double increment : increments) sums.add(increment);
  return sums;
}

}  // namespace

ChangePoint find_change(std::span<const double> increments) {
  ChangePoint result;
  const ChangeSums all = sum_of(increments);
  if (!(all.square > 0.0)) return result;
  ChangeSums so_far;
  double farthest = 0.0;
  double likeliest = 0.0;
  for (std::size_t k = 0; k < increments.size(); ++k) {
    const double time = so_far.square / all.square;
    const double distance = std::abs(so_far.value - time * all.value) / std::sqrt(all.square);
    farthest = std::max(farthest, distance);
    const double deviate =
        time > kMargin && time < 1.0 - kMargin ? distance / std::sqrt(time * (1.0 - time)) : 0.0;
    if (deviate > likeliest) {
      likeliest = deviate;
      result.at_sample = k;
      result.before = so_far.mean();
    }
    so_far.add(increments[k]);
  }
  result.p = bridge_upper(farthest);
  result.after = sum_of(increments.subspan(result.at_sample)).mean();
  return result;
}

}  // namespace loopscope::core::model
