#include "core/model/fit/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/model/fit/design.hpp"
#include "core/model/fit/newton_step.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::VectorXd;

double mean_square(const VectorXd& values, const std::vector<Range>& rows) {
  std::size_t count = 0;
  for (const Range& range : rows) count += range.size();
  return count == 0 ? 0.0 : sum_of_squares(values.data(), rows) / static_cast<double>(count);
}

/// Into `solution`, whose memory serves again.
void solve(const LoopData& data, const DesignMaker& maker, const Structure& structure,
           Solution& solution) {
  maker.make(structure, solution.design);
  solution.normal = products(solution.design.columns(), data.rows.fit);
  const Eigen::Index terms = solution.design.terms();
  solution.coefficients = solve_normal(solution.normal.bottomRightCorner(terms, terms),
                                       solution.normal.col(0).tail(terms));
  solution.errors = solution.design.table.col(0);
  solution.errors.noalias() -= solution.design.regressors() * solution.coefficients;
  solution.fit_error = mean_square(solution.errors, data.rows.fit);
}

/// The numerator that the last fit found, of gain 1; a gain of about nothing has none.
std::array<double, 2> numerator_of(const Structure& structure, const VectorXd& coefficients) {
  if (!structure.two_taps) return {1.0, 0.0};
  const double sum = coefficients[0] + coefficients[1];
  const double size = std::abs(coefficients[0]) + std::abs(coefficients[1]);
  if (std::abs(sum) < 0.05 * size) return {1.0, 0.0};
  return {coefficients[0] / sum, coefficients[1] / sum};
}

Fit finished(const LoopData& data, const Structure& structure, const Solution& solution) {
  Fit fit;
  fit.structure = structure;
  fit.coefficients.assign(solution.coefficients.begin(), solution.coefficients.end());
  fit.innovations.assign(solution.errors.begin(), solution.errors.end());
  fit.fit_error = solution.fit_error;
  fit.score_error = mean_square(solution.errors, data.rows.score);
  fit.structure.process.numerator = numerator_of(structure, solution.coefficients);
  return fit;
}

/// Whether a fit may still come below an error. Of 5000 steps the whole way from there on, in n ln,
/// was more than three times the promise of the first in 3 %.
class EarlyStop {
 public:
  EarlyStop(const LoopData& data, double to_beat)
      : to_beat_(to_beat), slack_(1.0 / static_cast<double>(data.rows.fit_count() + 1)) {}
  [[nodiscard]] bool is_left(double error, double promise) const {
    constexpr double kTimes = 3.0;
    constexpr double kMost = 0.99;
    // A promise is of a parabola, which has no bottom at nothing.
    const double promised = -std::log1p(-std::clamp(promise, 0.0, kMost));
    return std::log(error / to_beat_) < kTimes * promised + slack_;
  }

 private:
  double to_beat_;
  double slack_;  ///< 1 in n ln
};

}  // namespace

std::span<const double> coefficients_of(const Fit& fit, std::size_t place) {
  const auto& effects = fit.structure.effects;
  std::size_t offset = fit.taps();
  for (std::size_t i = 0; i < place; ++i) offset += effects[i]->column_count();
  return std::span(fit.coefficients).subspan(offset, effects[place]->column_count());
}

Fit evaluate(const LoopData& data, const Structure& structure) {
  Solution solution;
  solve(data, DesignMaker(data, structure.effects), structure, solution);
  return finished(data, structure, solution);
}

std::vector<double> deterministic_output(const LoopData& data, const Fit& fit) {
  Structure structure = fit.structure;
  structure.noise = {1, {}, {}};
  const Design design = DesignMaker(data, structure.effects).make(structure);
  const Eigen::Map<const VectorXd> coefficients(fit.coefficients.data(), design.terms());
  const VectorXd output = design.regressors() * coefficients;
  return {output.begin(), output.end()};
}

Fit polish(const LoopData& data, const Structure& start, int iterations, double to_beat) {
  constexpr double kWorthwhile = 1e-4;  // relative gain of a step below which the fit has settled
  constexpr double kPromising = 0.5 * kWorthwhile;  // a promise below which there is none to come
  const EarlyStop hope(data, to_beat);
  const DesignMaker maker(data, start.effects);
  Structure structure = start;
  Solution solution, tried;
  solve(data, maker, structure, solution);
  std::optional<NewtonStep> step;  // until one is taken, the same with more damping
  double damping = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    if (!step) step.emplace(data, solution, structure);
    const NextStructure next = step->take(damping);
    if (next.promise < kPromising || !hope.is_left(solution.fit_error, next.promise)) break;
    solve(data, maker, next.structure, tried);
    if (tried.fit_error < solution.fit_error) {
      const double gained = 1.0 - tried.fit_error / solution.fit_error;
      structure = next.structure;
      structure.process.numerator = numerator_of(structure, tried.coefficients);
      std::swap(solution, tried);
      step.reset();
      damping *= 0.1;
      if (gained < kWorthwhile) break;
    } else {
      damping = std::max(damping * 30.0, 1e-2);
      if (damping > 1e3) break;
    }
  }
  return finished(data, structure, solution);
}

}  // namespace loopscope::core::model
