#include "daemon/plant/event_record.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::daemon {
namespace {

using core::plant::MemberLoop;
using core::plant::Role;
using core::plant::SharedOscillation;
using testing::ElementsAre;
using testing::SizeIs;

/// Three loops of ids 10, 11 and 12; the last is the source.
SharedOscillation shared() {
  SharedOscillation event;
  event.period_s = 20.0;
  event.p = 1e-4;
  event.source = 2;
  event.outside = 0.1;
  event.statement = "words";
  event.members = {{2, 12, Role::source, 0.3, 0.0, 1e-9, 0.7},
                   {0, 10, Role::victim, 0.8, 4.0, 1e-9, 0.1},
                   {1, 11, Role::member, 0.5, 6.0, 1e-9, 0.1}};
  event.ranking = {{2, 12, 0.7, {"for it"}}, {1, 11, 0.1, {"against it"}}};
  event.leads = {{2, 0, 0.5, 0.25}};
  return event;
}

TEST(EventRecord, TellsLoopsByTheirIdsAndKeepsWhatIsShown) {
  std::vector<double> error;
  for (int k = 0; k < 1000; ++k) error.push_back(std::sin(0.1 * M_PI * k));
  std::vector<MemberLoop> loops(3);
  for (std::size_t k = 0; k < loops.size(); ++k) {
    loops[k].id = 10 + static_cast<std::int64_t>(k);
    loops[k].error = error;
  }
  const storage::PlantEvent event = event_record(shared(), loops);
  EXPECT_EQ(event.source_loop_id, 12);
  EXPECT_EQ(event.outside, 0.1);
  ASSERT_THAT(event.members, SizeIs(3));
  EXPECT_EQ(event.members[0].loop_id, 12);
  EXPECT_THAT(event.members[0].reasons, ElementsAre("for it"));
  EXPECT_THAT(event.members[1].reasons, ElementsAre());
  EXPECT_THAT(event.members[2].reasons, ElementsAre("against it"));
  ASSERT_THAT(event.leads, SizeIs(1));
  EXPECT_EQ(event.leads[0].from_loop_id, 12);
  EXPECT_EQ(event.leads[0].to_loop_id, 10);
  EXPECT_EQ(event.leads[0].direct, 0.25);
  ASSERT_THAT(event.traces, SizeIs(3));
  EXPECT_EQ(event.traces[0].loop_id, 12);
  EXPECT_EQ(event.traces[1].loop_id, 10);
  EXPECT_THAT(event.traces[1].error, SizeIs(240));
}

}  // namespace
}  // namespace loopscope::daemon
