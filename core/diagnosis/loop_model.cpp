#include "core/diagnosis/loop_model.hpp"

#include "core/model/explain.hpp"

namespace loopscope::core {

std::optional<model::Explanation> explain_loop(const FirstLook& first, const LoopFacts& facts) {
  const signal::PreparedLoop& loop = first.loop;
  return model::explain({loop.pv, loop.op_percent, loop.sp, loop.error, loop.sample_interval_s,
                         loop.op_range_known, facts.seed});
}

}  // namespace loopscope::core
