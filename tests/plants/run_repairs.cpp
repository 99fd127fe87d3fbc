#include "tests/plants/run_repairs.hpp"

#include <fmt/format.h>

#include "daemon/calibrate/in_threads.hpp"

namespace loopscope::tests::repairs {

std::vector<DiagnosedRepair> run_repairs(const RepairPlan& plan) {
  std::vector<DiagnosedRepair> repairs(plan.repairs);
  daemon::in_threads(plan.repairs, plan.threads, [&]() -> daemon::IndexedTask {
    return [&](std::size_t i) {
      const Repair repair = draw_repair(static_cast<Word>(i % kWords), plan.seed + i);
      repairs[i] = diagnose_repair(repair, fmt::format("repair {:04}", i + 1));
    };
  });
  return repairs;
}

}  // namespace loopscope::tests::repairs
