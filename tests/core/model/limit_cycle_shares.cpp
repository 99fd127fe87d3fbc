#include "tests/core/model/limit_cycle_shares.hpp"

#include <cstdint>

namespace loopscope::core::model::tests {

CycleCause judge(const loopscope::tests::model::FieldLoop& loop) {
  return judge_limit_cycle(loop.pv, loop.op, loop.sp);
}

double right_share(const loopscope::tests::model::FieldFamily& family, std::size_t records) {
  std::size_t right = 0;
  for (std::uint64_t seed = 0; seed < records; ++seed) {
    const auto decision = judge(record_of(family, seed)).decision;
    const bool accused = decision == CycleCause::Decision::sticks;
    if (accused == family.sticks) ++right;
  }
  return static_cast<double>(right) / static_cast<double>(records);
}

}  // namespace loopscope::core::model::tests
