#include "core/diagnosis/loop_model.hpp"

namespace loopscope::core {

std::optional<model::Explanation> explain_loop(const FirstLook& /*first*/,
                                               const LoopFacts& /*facts*/) {
  return std::nullopt;
}

}  // namespace loopscope::core
