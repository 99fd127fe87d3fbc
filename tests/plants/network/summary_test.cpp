#include "tests/plants/network/summary.hpp"

#include <gmock/gmock.h>

namespace loopscope::tests::network {
namespace {

using testing::HasSubstr;

Outcome outcome(const std::string& source, const std::string& named, std::size_t rank) {
  Outcome one;
  one.origin = source.empty() ? Origin::outside : Origin::valve;
  one.source = source;
  one.named = named;
  one.rank = rank;
  one.found = true;
  one.carriers = 5;
  one.carriers_found = 4;
  return one;
}

TEST(PlantSummary, CountsPlantsWithAndWithoutASource) {
  const Summary summary = summarise({outcome("A", "A", 1), outcome("A", "B", 2),
                                     outcome("A", "", 0), outcome("", "C", 0), outcome("", "", 0)});
  EXPECT_EQ(summary.plants, 3U);
  EXPECT_EQ(summary.source_first, 1U);
  EXPECT_EQ(summary.source_top3, 2U);
  EXPECT_EQ(summary.source_named, 2U);
  EXPECT_EQ(summary.named_right, 1U);
  EXPECT_EQ(summary.outside_plants, 2U);
  EXPECT_EQ(summary.outside_named, 1U);
  EXPECT_EQ(summary.carriers_found, 20U);
  EXPECT_EQ(summary.wrong.size(), 3U);
}

TEST(PlantSummary, IsATableAndAnObject) {
  const Summary summary = summarise({outcome("A", "A", 1)});
  EXPECT_THAT(table_of(summary), HasSubstr("source ranked first"));
  EXPECT_THAT(json_of(summary), HasSubstr("\"source_first\": 1"));
  EXPECT_THAT(json_of(summarise({})), HasSubstr("\"plants\": 0"));
}

}  // namespace
}  // namespace loopscope::tests::network
