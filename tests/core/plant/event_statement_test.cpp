#include "core/plant/event_statement.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace loopscope::core::plant {
namespace {

/// So many loops, L0 to ..., without a fault of their own.
std::vector<MemberLoop> named_loops(std::size_t count) {
  std::vector<MemberLoop> loops(count);
  for (std::size_t k = 0; k < count; ++k) loops[k].name = "L" + std::to_string(k);
  return loops;
}

/// All of them in one oscillation of a minute and a half, of which the first is named as the
/// source.
SharedOscillation event_of(std::size_t count) {
  SharedOscillation event;
  event.period_s = 90.0;
  event.source = 0;
  for (std::size_t k = 0; k < count; ++k) {
    event.members.push_back({.index = k, .role = k == 0 ? Role::source : Role::victim});
    event.ranking.push_back({k, 0, k == 0 ? 0.83 : 0.1, {}});
  }
  event.ranking.front().reasons = {"Its valve sticks."};
  return event;
}

const std::string kThree =
    "3 loops take part in one oscillation with a period of 90 s: L0, L1, L2.";
const std::string kFromL0 =
    " It comes from L0 (probability 83 %). Its valve sticks. Repair L0 first; the others follow it "
    "and should stop oscillating once it is repaired.";

TEST(PlantStatement, SaysWhatWhereFromWhyAndWhatToDo) {
  EXPECT_EQ(statement_of(event_of(3), named_loops(3)), kThree + kFromL0);
}

TEST(PlantStatement, NamesSixLoopsAndCountsTheOthers) {
  const std::string shown =
      " loops take part in one oscillation with a period of 90 s: L0, L1, L2, L3, L4, L5";
  EXPECT_EQ(statement_of(event_of(6), named_loops(6)), "6" + shown + "." + kFromL0);
  EXPECT_EQ(statement_of(event_of(9), named_loops(9)), "9" + shown + " and 3 more." + kFromL0);
}

TEST(PlantStatement, ALoopWithoutANameIsCalledByItsNumber) {
  std::vector<MemberLoop> loops = named_loops(3);
  loops[1].name.clear();
  loops[1].id = 17;
  EXPECT_EQ(
      statement_of(event_of(3), loops),
      "3 loops take part in one oscillation with a period of 90 s: L0, loop 17, L2." + kFromL0);
}

TEST(PlantStatement, WithoutASourceItSaysWhereToLook) {
  SharedOscillation event = event_of(3);
  event.source.reset();
  event.ranking.front().score = 0.4;
  event.outside = 0.3;
  EXPECT_EQ(statement_of(event, named_loops(3)),
            kThree +
                " Its source is not clear: L0 is the most likely member (40 %). If operations "
                "agrees, put its controller in manual for a few periods and see whether the others "
                "stop oscillating.");
  event.outside = 0.5;
  EXPECT_EQ(statement_of(event, named_loops(3)),
            kThree +
                " No member stands out as its source (most likely L0, 40 %): check what these "
                "loops have in common upstream: supplies, and loops that are not recorded.");
}

TEST(PlantStatement, FaultsBesideTheOscillationAreNamed) {
  std::vector<MemberLoop> loops = named_loops(3);
  loops[1].own.fault = Fault::sensor;
  loops[2].own.fault = Fault::friction;
  SharedOscillation event = event_of(3);
  event.members[1].role = Role::member;
  EXPECT_EQ(statement_of(event, loops),
            kThree + kFromL0 +
                " With a finding of their own, and kept on the list: L1. Judged alone, a valve "
                "would be blamed for the same cycle; when the source is repaired, check these "
                "again: L2.");
}

}  // namespace
}  // namespace loopscope::core::plant
