#include "tests/plants/network/options.hpp"

#include <gtest/gtest.h>
#include <tuple>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::network {
namespace {

TEST(PlantOptions, DefaultIsFortyPlantsAndAQuarterOutside) {
  const Options options = read_options({});
  EXPECT_EQ(options.plants, 40U);
  EXPECT_EQ(options.outside, 10U);
  EXPECT_EQ(read_options({"--plants", "8"}).outside, 2U);
  EXPECT_EQ(read_options({"--outside", "3", "--plants", "8"}).outside, 3U);
}

TEST(PlantOptions, ReadsEveryOption) {
  const Options options = read_options(
      {"--seed", "7", "--threads", "2", "--json", "--criteria", "--evidence", "file.csv"});
  EXPECT_EQ(options.seed, 7U);
  EXPECT_EQ(options.threads, 2U);
  EXPECT_TRUE(options.json);
  EXPECT_TRUE(options.criteria);
  EXPECT_EQ(options.evidence_file, "file.csv");
  EXPECT_EQ(read_options({"--independent", "500"}).independent, 500U);
  EXPECT_TRUE(read_options({"--help"}).help);
}

TEST(PlantOptions, RefusesWhatItCannotRead) {
  EXPECT_THROW(std::ignore = read_options({"--seeds", "7"}), WrongUsage);
  EXPECT_THROW(std::ignore = read_options({"--seed"}), WrongUsage);
  EXPECT_THROW(std::ignore = read_options({"--seed", "x"}), WrongUsage);
  EXPECT_THROW(std::ignore = read_options({"--threads", "0"}), WrongUsage);
}

}  // namespace
}  // namespace loopscope::tests::network
