#pragma once

#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/selection/stepwise_model.hpp"

namespace loopscope::core::model {

/// The linear loop of a record and what its residual says first.
struct BaselineAnalysis {
  ModelInput recorded;     ///< a value for each sample
  ModelInput at_rows;      ///< a value for each row; the same, unless the sensor is held
  StepwiseModel stepwise;  ///< the linear baseline; no effect sought before select_and_report()
  std::vector<TestOutcome> answers;  ///< that the model starts from (run_residual_tests.hpp)
  [[nodiscard]] double baseline_error() const;  ///< held out, pv units squared
  /// The same over the rows of both kinds, pv units squared, each as unseen by the fit to the
  /// other: half as many are few where the sensor is held.
  [[nodiscard]] double error_of_both_halves() const;
};

/// pv and op of `recorded` are modelled on the rows of `grid`; `at_rows` has the same rows. What
/// both inputs view has to outlive the analysis. Throws std::invalid_argument for series of
/// different lengths and an interval that is not positive.
[[nodiscard]] BaselineAnalysis analyse_baseline(const ModelInput& recorded,
                                                const ModelInput& at_rows, const RowGrid& grid);
/// Every sample is a row.
[[nodiscard]] BaselineAnalysis analyse_baseline(const ModelInput& recorded);

/// The linear loop in the results' words, nothing judged yet.
[[nodiscard]] Explanation begin_explanation(const BaselineAnalysis& analysis);
/// The loop with every effect that the data ask for; they are `analysis.stepwise.selected` then.
[[nodiscard]] Explanation select_and_report(BaselineAnalysis& analysis);
/// The linear loop alone.
[[nodiscard]] Explanation report_linear_model(const BaselineAnalysis& analysis);

/// Fills noise floor, questions and `unexplained` for the linear loop.
void report_linear_rest(const BaselineAnalysis& analysis, Explanation& explanation);

}  // namespace loopscope::core::model
