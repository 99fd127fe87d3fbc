// The lease protocol as a state machine: workers claim, extend, complete, fail, release, stall and
// come back late in any order, on a real server; a model in memory says what has to be there after
// every step.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/storage/results/lease_world.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class LeaseProtocol : public ResultsTest {};

TEST_F(LeaseProtocol, EveryHistoryIsTheModels) {
  add_loops({"a", "b", "c", "d"});
  LeaseWorld world(*database);
  const bool holds = rc::check("any order of deeds", [&world] {
    const auto steps = *rc::gen::container<std::vector<Step>>(any_step());
    world.begin();
    for (const Step& step : steps) {
      world.take(step);
      world.check();
    }
  });
  EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace loopscope::storage
