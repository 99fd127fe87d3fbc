#include "core/model/residual_tests/tests/time_spread.hpp"

#include <cmath>

#include "core/model/residual_tests/statistics/change_point.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

struct Magnitudes {
  std::vector<double> about_mean;  ///< |r| less its mean; 0 = missing
  double mean = 0.0;
};

Magnitudes magnitudes_of(const Centred& residual) {
  Magnitudes result{residual.values, 0.0};
  for (double& r : result.about_mean) {
    r = std::abs(r);
    result.mean += r / static_cast<double>(residual.recorded);
  }
  for (double& r : result.about_mean) r = r == 0.0 ? 0.0 : r - result.mean;
  return result;
}

}  // namespace

TestOutcome test_time_spread(const ResidualContext& context) {
  const Magnitudes magnitudes = magnitudes_of(context.fresh);
  const ChangePoint change = find_change(magnitudes.about_mean);
  TestOutcome answer{{"time_spread", change.p, {}}, {}};
  if (change.p <= kSignificant)
    answer.question.statement =
        "The residual is " +
        text::number((magnitudes.mean + change.after) / (magnitudes.mean + change.before)) +
        " times as large from " + text::at_place(change.at_sample, context.view.sample_interval_s) +
        " on.";
  return answer;
}

}  // namespace loopscope::core::model
