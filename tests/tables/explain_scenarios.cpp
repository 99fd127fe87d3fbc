#include <cstddef>

#include "tests/core/model/scenario_shares.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

using tests::Faulty;
using tests::faulty_scenarios;
using tests::shares_of;

constexpr std::size_t kManyRecords = 100;

LOOPSCOPE_TABLE(explain_faulty, "first effects of 100 records of each faulty scenario") {
  for (const Faulty& faulty : faulty_scenarios()) {
    print(faulty.scenario, shares_of(faulty.scenario, faulty.right, kManyRecords));
  }
}

LOOPSCOPE_TABLE(explain_healthy, "first effects of 100 records of each healthy scenario") {
  for (const char* scenario : tests::kHealthyScenarios)
    print(scenario, shares_of(scenario, {}, kManyRecords));
}

}  // namespace
}  // namespace loopscope::core::model
