#include "core/model/results/mechanism.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

TEST(Mechanism, EveryOneIsFoundByItsName) {
  for (const Mechanism mechanism : all_mechanisms()) {
    EXPECT_FALSE(name(mechanism).empty());
    EXPECT_EQ(mechanism_of(name(mechanism)), mechanism);
  }
  EXPECT_EQ(mechanism_of("luck"), std::nullopt);
}

TEST(Mechanism, NothingIsLeftOutUnlessSomebodySaysSo) {
  Without without;
  for (const Mechanism mechanism : all_mechanisms()) EXPECT_TRUE(without.keeps(mechanism));
  without.leave_out(Mechanism::stem_search);
  for (const Mechanism mechanism : all_mechanisms())
    EXPECT_EQ(without.keeps(mechanism), mechanism != Mechanism::stem_search);
}

}  // namespace
}  // namespace loopscope::core::model
