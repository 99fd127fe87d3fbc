#include "tests/plants/run_repairs.hpp"

#include <fmt/format.h>

#include "tests/support/in_threads.hpp"

namespace loopscope::tests::repairs {

std::vector<DiagnosedRepair> run_repairs(const RepairPlan& plan) {
  std::vector<DiagnosedRepair> repairs(plan.repairs);
  in_threads(plan.repairs, plan.threads, [&](std::size_t i) {
    const Repair repair = draw_repair(static_cast<Word>(i % kWords), plan.seed + i);
    repairs[i] = diagnose_repair(repair, fmt::format("repair {:04}", i + 1));
  });
  return repairs;
}

}  // namespace loopscope::tests::repairs
