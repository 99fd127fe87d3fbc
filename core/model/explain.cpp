#include "core/model/explain.hpp"

#include <utility>

#include "core/model/loop_model_fit.hpp"

namespace loopscope::core::model {

std::optional<Explanation> explain(const ModelInput& input) {
  std::optional<FittedLoop> told = fit_loop_model(input);
  if (!told) return std::nullopt;
  return std::move(told->explanation);
}

}  // namespace loopscope::core::model
