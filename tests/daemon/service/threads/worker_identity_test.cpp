#include "daemon/service/threads/worker_identity.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

config::DaemonSettings of_cores(int cores, int batches_in_flight = 0) {
  config::DaemonSettings settings;
  settings.workers = cores;
  settings.batches_in_flight = batches_in_flight;
  return settings;
}

TEST(WorkerIdentity, ComparisonTakesTheBatchesOfACore) {
  EXPECT_EQ(workers_beside_comparison(of_cores(2)), 2U);
  EXPECT_EQ(workers_beside_comparison(of_cores(4)), 6U);
  EXPECT_EQ(workers_beside_comparison(of_cores(2, 16)), 8U);
  EXPECT_EQ(workers_beside_comparison(of_cores(3, 5)), 4U);
}

TEST(WorkerIdentity, SomebodyGoesOnBesideAComparison) {
  EXPECT_EQ(workers_beside_comparison(of_cores(1)), 1U);
  EXPECT_EQ(workers_beside_comparison(of_cores(1, 1)), 1U);
}

}  // namespace
}  // namespace loopscope::daemon
