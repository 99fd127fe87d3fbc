#include "daemon/report/text/loop_links.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(LoopLinks, OfADaemonsPageLeadToPages) {
  const LoopLinks links = LoopLinks::pages();
  EXPECT_TRUE(links.is_live());
  EXPECT_EQ(links.to_loop(7, "a b"), "/loop?name=a%20b");
  EXPECT_EQ(links.to_page("a\"b"), "/loop?name=a%22b");
  EXPECT_EQ(links.to_loops("?state=flagged"), "/loops?state=flagged");
}

TEST(LoopLinks, OfAReportLeadToSectionsAndWhereKnownToPages) {
  const LoopLinks alone = LoopLinks::sections({7});
  EXPECT_FALSE(alone.is_live());
  EXPECT_EQ(alone.to_loop(7, "a"), "#loop-7");
  EXPECT_EQ(alone.to_loop(8, "b") + alone.to_page("a") + alone.to_loops(""), "");
  const LoopLinks linked = LoopLinks::sections({7}, "https://pages");
  EXPECT_EQ(linked.to_loop(7, "a"), "#loop-7");
  EXPECT_EQ(linked.to_loop(8, "b"), "https://pages/loop?name=b");
  EXPECT_EQ(linked.to_loops("?area=x"), "https://pages/loops?area=x");
}

}  // namespace
}  // namespace loopscope::daemon
