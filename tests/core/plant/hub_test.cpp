#include "core/plant/hub.hpp"

#include <gtest/gtest.h>
#include <random>

#include "core/hos/numeric/normal_draw.hpp"

namespace loopscope::core::plant {
namespace {

TEST(Hub, HoldsItsRateOverIndependentNeighbours) {
  std::mt19937_64 random(61);
  constexpr int kStars = 4000;
  int rare = 0;
  for (int k = 0; k < kStars; ++k) {
    std::vector<Neighbour> around;
    for (std::size_t i = 1; i <= 20; ++i) around.push_back({i, hos::uniform_draw(random)});
    rare += find_hub(0, around).p <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(rare, 0.05 * kStars);
}

TEST(Hub, ManyFairFollowersSayAsMuchAsOneGoodOne) {
  std::vector<Neighbour> around;
  for (std::size_t i = 1; i <= 20; ++i) around.push_back({i, i <= 6 ? 0.01 : 0.5});
  const Hub hub = find_hub(7, around);
  EXPECT_EQ(hub.centre, 7U);
  EXPECT_EQ(hub.neighbours.size(), 6U);
  EXPECT_LE(hub.p, 1e-5);
}

TEST(Hub, OfNothingIsNone) {
  EXPECT_TRUE(find_hub(0, {}).neighbours.empty());
  EXPECT_EQ(find_hub(0, {}).p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::plant
