#include "core/plant/list_by_odds.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace loopscope::core::plant {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr double kNone = 0.0;  // whatever the loop's own probability

TEST(ListByOdds, TheMostProbableAsLongAsTheMeanDoubtAllows) {
  // Doubts 0.01, 0.05, 0.2: means 0.01, 0.03, 0.087.
  const std::vector<double> probability = {0.8, 0.99, 0.95};
  EXPECT_THAT(list_by_odds(probability, 0.1, kNone), Each(true));
  EXPECT_THAT(list_by_odds(probability, 0.05, kNone), ElementsAre(false, true, true));
  EXPECT_THAT(list_by_odds(probability, 0.009, kNone), Each(false));
}

TEST(ListByOdds, SureFaultsLendADoubtfulLoopNoPlace) {
  std::vector<double> probability(40, 0.999);
  probability.push_back(0.4);
  EXPECT_TRUE(list_by_odds(probability, 0.05, kNone).back());
  EXPECT_FALSE(list_by_odds(probability, 0.05, 0.9).back());
  probability.back() = 0.9;
  EXPECT_TRUE(list_by_odds(probability, 0.05, 0.9).back());
}

TEST(ListByOdds, EqualsComeTogetherAndWhatWasNotWeighedDoesNotCome) {
  const std::vector<double> probability = {0.9, 1.0, std::nan(""), 0.9};
  EXPECT_THAT(list_by_odds(probability, 0.06, kNone), ElementsAre(false, true, false, false));
  EXPECT_THAT(list_by_odds(probability, 0.07, kNone), ElementsAre(true, true, false, true));
  EXPECT_THAT(list_by_odds({}, 0.1, kNone), testing::IsEmpty());
}

TEST(ListByOdds, DownToALeastProbability) {
  const std::vector<double> probability = {0.99, 0.8, 0.4, std::nan("")};
  EXPECT_THAT(list_by_odds(probability, 0.3, 0.3), ElementsAre(true, true, true, false));
  EXPECT_THAT(list_by_odds(probability, 0.3, 0.5), ElementsAre(true, true, false, false));
  EXPECT_THAT(list_by_odds(probability, 0.2, 0.3), ElementsAre(true, true, false, false));
}

TEST(ListByOdds, RefusesWhatIsNoProbability) {
  EXPECT_THROW((void)list_by_odds(std::vector{1.1}, 0.1, kNone), std::invalid_argument);
  EXPECT_THROW((void)list_by_odds(std::vector{0.5}, -0.1, kNone), std::invalid_argument);
  EXPECT_THROW((void)list_by_odds(std::vector{0.5}, 0.1, 80.0), std::invalid_argument);
}

/// Where the probabilities hold, so does the share, however the loops hang together.
TEST(ListByOdds, TheShareOfLoopsWithoutAFaultIsHeld) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  constexpr int kPlants = 400, kLoops = 200;
  for (const double share : {0.02, 0.08}) {
    double sum = 0.0, squares = 0.0;
    for (int plant = 0; plant < kPlants; ++plant) {
      std::vector<double> probability;
      std::vector<bool> faulty;
      const double weather = uniform(random);  // common to all loops
      for (int k = 0; k < kLoops; ++k) {
        probability.push_back(std::pow(uniform(random), 1.0 + 4.0 * weather));
        faulty.push_back(uniform(random) < probability.back());
      }
      const std::vector<bool> listed = list_by_odds(probability, share, kNone);
      double count = 0.0, wrong = 0.0;
      for (std::size_t k = 0; k < listed.size(); ++k) {
        count += listed[k] ? 1.0 : 0.0;
        wrong += listed[k] && !faulty[k] ? 1.0 : 0.0;
      }
      const double of_list = count > 0.0 ? wrong / count : 0.0;
      sum += of_list;
      squares += of_list * of_list;
    }
    const double mean = sum / kPlants;
    const double error = std::sqrt((squares / kPlants - mean * mean) / kPlants);
    EXPECT_LE(mean, share + 3.0 * error);
    EXPECT_GE(mean, 0.5 * share) << "the list is no shorter than it may be";
  }
}

}  // namespace
}  // namespace loopscope::core::plant
