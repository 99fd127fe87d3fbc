#include "core/model/explain.hpp"

#include <utility>

#include "core/model/told_loop.hpp"

namespace loopscope::core::model {

std::optional<Explanation> explain(const ModelInput& input) {
  std::optional<ToldLoop> told = tell_loop(input);
  if (!told) return std::nullopt;
  return std::move(told->explanation);
}

}  // namespace loopscope::core::model
