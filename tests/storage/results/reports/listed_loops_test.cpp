#include "storage/results/reports/listed_loops.hpp"

#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace loopscope::storage {
namespace {

using testing::ElementsAre;

std::vector<std::string> names(const ListedLoops& rows) {
  std::vector<std::string> names;
  for (const LoopRow row : rows) names.emplace_back(row.name);
  return names;
}

TEST(ListedLoops, GivesBackWhatItWasGiven) {
  ListedLoops rows;
  {
    const std::string text = "of a result that has gone";
    LoopRow row;
    row.name = row.searched = row.state = row.health = text;
    row.area = row.unit = row.description = row.code = row.status = row.hidden_by = row.follows =
        row.shown_code = text;
    row.name_place = 1;
    row.area_place = 2;
    row.unit_place = 3;
    row.rank = 4;
    row.confidence = 0.25;
    row.slot_end_us = 0;
    row.enabled = true;
    rows.push_back(row);
  }
  rows.push_back({});
  const LoopRow full = rows[0], bare = rows[1];
  for (const std::string_view text : {full.name, full.searched, full.state, full.health})
    EXPECT_EQ(text, "of a result that has gone");
  for (const auto& text : {full.area, full.unit, full.description, full.code, full.status,
                           full.hidden_by, full.follows, full.shown_code})
    EXPECT_EQ(text, "of a result that has gone");
  EXPECT_EQ(full.name_place, 1);
  EXPECT_EQ(full.area_place, 2);
  EXPECT_EQ(full.unit_place, 3);
  EXPECT_EQ(full.rank, 4);
  EXPECT_EQ(full.confidence, 0.25);
  EXPECT_EQ(full.slot_end_us, 0);
  EXPECT_TRUE(full.enabled);
  EXPECT_EQ(bare.name, "");
  for (const auto& text : {bare.area, bare.unit, bare.description, bare.code, bare.status,
                           bare.hidden_by, bare.follows, bare.shown_code})
    EXPECT_EQ(text, std::nullopt);
  for (const auto& number :
       {bare.name_place, bare.area_place, bare.unit_place, bare.rank, bare.slot_end_us})
    EXPECT_EQ(number, std::nullopt);
  EXPECT_EQ(bare.confidence, std::nullopt);
  EXPECT_FALSE(bare.enabled);
}

/// More different texts than are remembered, each again and again; an empty one is not none.
TEST(ListedLoops, KeepsEveryTextApart) {
  constexpr std::size_t kLoops = 50'000;
  ListedLoops rows;
  const auto area_of = [](std::size_t k) { return "area " + std::to_string(k % 7'000); };
  for (std::size_t k = 0; k < kLoops; ++k) {
    const std::string name = std::to_string(k), area = area_of(k);
    LoopRow row;
    row.name = name;
    row.area = area;
    row.unit = "";
    rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), kLoops);
  const ListedLoops copy = rows;
  for (std::size_t k = 0; k < kLoops; ++k) {
    ASSERT_EQ(copy[k].name, std::to_string(k));
    ASSERT_EQ(copy[k].area, area_of(k));
    ASSERT_EQ(copy[k].unit, "");
  }
}

TEST(ListedLoops, PutsTheFlaggedFirstAndLeavesTheOthersInOrder) {
  ListedLoops rows;
  const std::vector<std::pair<std::string, std::int64_t>> given{
      {"a", 0}, {"b", 3}, {"c", 0}, {"d", 1}, {"e", 2}};
  for (const auto& [name, rank] : given) {
    LoopRow row;
    row.name = name;
    if (rank > 0) row.rank = rank;
    rows.push_back(row);
  }
  rows.put_flagged_first();
  EXPECT_THAT(names(rows), ElementsAre("d", "e", "b", "a", "c"));
  EXPECT_THAT(names({}), ElementsAre());
}

}  // namespace
}  // namespace loopscope::storage
