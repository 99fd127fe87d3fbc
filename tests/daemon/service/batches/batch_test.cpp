#include "daemon/service/batches/batch.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

storage::ClaimedLoop claim_of(std::int64_t loop_id) {
  storage::ClaimedLoop claim;
  claim.loop.loop_id = loop_id;
  claim.loop.name = "FIC";
  return claim;
}

/// A window of one loop cannot be prepared, then the source dies: the loop keeps its blame and its
/// pause, and is given back once.
TEST(Batch, WhatWasSetAsideIsNotPostponedToo) {
  const storage::ClaimedLoop broken = claim_of(1), sound = claim_of(2);
  WindowCache cache;
  const std::string settings_json;
  Batch batch{KeptWindows(cache, std::make_shared<config::Settings>(), settings_json)};
  set_aside(broken, {ExitCode::fault, "out of memory", "fewer workers"}, batch);
  postpone({&broken, &sound}, {ExitCode::database, "away", "start it"}, 30.0, batch);
  ASSERT_EQ(batch.failed.size(), 2U);
  EXPECT_EQ(batch.failed[0].loop_id, 1);
  EXPECT_TRUE(batch.failed[0].at_fault);
  EXPECT_EQ(batch.failed[1].loop_id, 2);
  EXPECT_FALSE(batch.failed[1].at_fault);
  EXPECT_STREQ(batch.first_failure->what(), "out of memory");
}

}  // namespace
}  // namespace loopscope::daemon
