#include "tests/plants/plant_faults_options.hpp"

#include <gtest/gtest.h>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::plants {
namespace {

TEST(PlantFaultsOptions, AreReadInAnyOrder) {
  const Options options =
      read_options({"--json", "--seed", "9", "--history", "--end", "100", "--loops", "40"});
  EXPECT_EQ(options.task, Options::Task::history);
  EXPECT_EQ(options.seed, 9U);
  EXPECT_EQ(options.end_us, 100'000'000);
  EXPECT_EQ(options.size.loops, 40U);
  EXPECT_EQ(options.size.faulty, 25U);
  EXPECT_TRUE(options.json);
  EXPECT_EQ(read_options({"--rate", "0.02"}).rule.false_discovery_rate, 0.02);
  const Options without = read_options({"--without", "play_net"});
  EXPECT_FALSE(without.without.keeps(core::model::Mechanism::play_net));
  EXPECT_TRUE(without.without.keeps(core::model::Mechanism::stem_search));
}

TEST(PlantFaultsOptions, WrongWordsAreNamed) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--sed", "1"},
                                                {"--seed"},
                                                {"--seed", "x"},
                                                {"plant"},
                                                {"--rate", "0"},
                                                {"--rate", "much"},
                                                {"--without", "luck"},
                                                {"--score", "--without", "play_net"},
                                                {"--loops", "3"}})
    EXPECT_THROW(static_cast<void>(read_options(words)), WrongUsage) << words.front();
}

}  // namespace
}  // namespace loopscope::tests::plants
