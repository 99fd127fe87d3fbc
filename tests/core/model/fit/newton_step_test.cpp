#include "core/model/fit/newton_step.hpp"

#include <gtest/gtest.h>

#include "core/model/fit/design.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kStepSamples = 2000;

LoopData record_with(double pole) {
  const tests::Series op = tests::stepping_op(kStepSamples, 1);
  return make_loop_data(tests::process_record(tests::one_lag(pole, 3), 1.5, op,
                                              tests::white_noise(kStepSamples, 2, 0.1)),
                        op, 1.0);
}

Solution solved(const LoopData& data, const Structure& structure) {
  const Fit fit = evaluate(data, structure);
  Solution solution;
  solution.design = DesignMaker(data, structure.effects).make(structure);
  solution.normal = products(solution.design.columns(), data.rows.fit);
  solution.coefficients = Eigen::Map<const Eigen::VectorXd>(
      fit.coefficients.data(), static_cast<Eigen::Index>(fit.coefficients.size()));
  solution.errors = Eigen::Map<const Eigen::VectorXd>(
      fit.innovations.data(), static_cast<Eigen::Index>(fit.innovations.size()));
  solution.fit_error = fit.fit_error;
  return solution;
}

TEST(NewtonStep, GoesTowardsTheTruePole) {
  const LoopData data = record_with(0.8);
  const Structure start = tests::structure_of(tests::one_lag(0.75, 3));
  const Structure next = NewtonStep(data, solved(data, start), start).take(1e-3).structure;
  EXPECT_NEAR(next.process.pole, 0.8, 0.02);
  EXPECT_LT(evaluate(data, next).fit_error, evaluate(data, start).fit_error);
}

TEST(NewtonStep, IsShorterWithMoreDampingAndTheSameWhenTakenAgain) {
  const LoopData data = record_with(0.8);
  const Structure start = tests::structure_of(tests::one_lag(0.75, 3));
  const NewtonStep step(data, solved(data, start), start);
  const double freely = step.take(1e-3).structure.process.pole - start.process.pole;
  const double damped = step.take(10.0).structure.process.pole - start.process.pole;
  EXPECT_GT(freely, damped);
  EXPECT_GT(damped, 0.0);
  EXPECT_EQ(step.take(1e-3).structure.process.pole,
            NewtonStep(data, solved(data, start), start).take(1e-3).structure.process.pole);
}

/// Near the best fit the error is a parabola.
TEST(NewtonStep, PromisesWhatItGains) {
  const LoopData data = record_with(0.8);
  const Structure start = tests::structure_of(tests::one_lag(0.79, 3));
  const Solution before = solved(data, start);
  const NextStructure next = NewtonStep(data, before, start).take(1e-9);
  const double gained = 1.0 - evaluate(data, next.structure).fit_error / before.fit_error;
  EXPECT_NEAR(next.promise, gained, 0.2 * gained);
}

/// One factorisation for all right sides, collinear columns and idle ones included.
TEST(SolveNormal, AgreesWithItsInverse) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Random(40, 5);
  columns.col(3) = 2.0 * columns.col(1);
  columns.col(4).setZero();
  const Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::VectorXd right = columns.transpose() * Eigen::VectorXd::LinSpaced(40, -1.0, 1.0);
  const Eigen::VectorXd solved = solve_normal(normal, right);
  EXPECT_LT((inverse_of_normal(normal) * right - solved).norm(), 1e-6 * solved.norm());
}

}  // namespace
}  // namespace loopscope::core::model
