#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/plants/diagnose_repair.hpp"

namespace loopscope::tests::repairs {

/// Repair i has the seed `seed` + i; the four words take turns.
struct RepairPlan {
  std::uint64_t seed = 1;
  std::size_t repairs = 80;
  unsigned threads = 1;
};

/// Draws and diagnoses; the same for any number of threads. Throws what one of them throws.
[[nodiscard]] std::vector<DiagnosedRepair> run_repairs(const RepairPlan& plan);

}  // namespace loopscope::tests::repairs
