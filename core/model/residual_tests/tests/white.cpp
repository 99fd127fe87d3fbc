#include "core/model/residual_tests/tests/white.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/residual_tests/statistics/tails.hpp"
#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kPortmanteauLags = 25;
/// In standard deviations. Skewed noise makes sums of products skewed: of exponential noise 11 %
/// would be called coloured at 5 % in 750 samples.
constexpr double kClip = 2.0;

struct LagSums {
  double product = 0.0;
  double squares = 0.0;
  [[nodiscard]] double t() const { return squares > 0.0 ? product / std::sqrt(squares) : 0.0; }
};

LagSums at_lag(const std::vector<double>& r, std::size_t lag) {
  LagSums sums;
  for (std::size_t k = lag; k < r.size(); ++k) {
    const double product = r[k] * r[k - lag];
    sums.product += product;
    sums.squares += product * product;
  }
  return sums;
}

/// Outliers brought in: what was independent stays so.
std::vector<double> clipped(const Centred& residual) {
  std::vector<double> values = residual.values;
  double mean = 0.0;
  for (double& r : values) {
    r = std::clamp(r, -kClip, kClip);
    mean += r / static_cast<double>(residual.recorded);
  }
  for (double& r : values) r = r == 0.0 ? 0.0 : r - mean;
  return values;
}

}  // namespace

TestOutcome test_white(const ResidualContext& context) {
  const std::vector<double> r = clipped(context.residual);
  double sum = 0.0;
  double strongest = 0.0;
  std::size_t strongest_lag = 1;
  for (std::size_t lag = 1; lag <= kPortmanteauLags; ++lag) {
    const double t = at_lag(r, lag).t();
    sum += t * t;
    if (std::abs(t) <= std::abs(strongest)) continue;
    strongest = t;
    strongest_lag = lag;
  }
  TestOutcome answer{{"white", chi_square_p(sum, kPortmanteauLags), {}}, {}};
  if (answer.question.p <= kSignificant)
    answer.question.statement =
        "The residual is autocorrelated, most at " +
        text::duration(static_cast<double>(strongest_lag) * context.view.sample_interval_s) + " (" +
        text::counted(strongest_lag, "sample", "samples") + ") before, " +
        text::number(std::abs(strongest)) + " standard errors, " +
        (strongest > 0.0 ? "with the same sign." : "with the opposite sign.");
  return answer;
}

}  // namespace loopscope::core::model
