#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/results/explanation.hpp"
#include "tests/effects/generator.hpp"

namespace loopscope::tests::effects {

/// What was said of one record, against its truth.
struct Outcome {
  std::string verdict;
  double confidence = 0.0;
  bool verdict_right = false;
  bool accuses_hardware = false;  ///< verdict or a step names valve, process or sensor
  bool misleads = false;          ///< the verdict names a cause, and a wrong one
  double milliseconds = 0.0;      ///< of the diagnosis
  double explainable = 0.0;       ///< of the record, see Truth

  /// The rest only where the diagnosis carries a model.
  bool modelled = false;
  std::vector<std::string> steps;  ///< their effects, in order
  bool named_right = false;        ///< the first step's effect; of kinds without any: no step
  std::vector<bool> asked_for;     ///< of each step: by a residual test
  std::size_t first_rank = 0;      ///< of the first step, by what it promised; 0 = not asked for
  bool all_found = false;          ///< every effect of the record has its step
  std::map<std::string, double> parameter_errors;  ///< relative, "effect.parameter" of right steps
  std::optional<double> error_before;              ///< one-step errors by the true floor
  std::optional<double> error_after;
  std::optional<double> model_floor;  ///< the model's own estimate by the true floor
};

/// `model` = nullptr: the diagnosis has none.
[[nodiscard]] Outcome judge(const Record& record, const std::string& verdict, double confidence,
                            const core::model::Explanation* model);

}  // namespace loopscope::tests::effects
