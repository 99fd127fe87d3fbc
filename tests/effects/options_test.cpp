#include "tests/effects/options.hpp"

#include <gtest/gtest.h>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::effects {
namespace {

TEST(EffectsOptions, DefaultIsEveryKind) {
  const Options options = read_options({});
  EXPECT_EQ(options.plan.kinds.size(), all_kinds().size());
  EXPECT_GE(options.plan.threads, 1U);
}

TEST(EffectsOptions, ReadsSeedDrawsAndKinds) {
  const Options options =
      read_options({"--seed", "7", "--draws", "3", "--kinds", "tight,load_step", "--json"});
  EXPECT_EQ(options.plan.seed, 7U);
  EXPECT_EQ(options.plan.draws, 3U);
  EXPECT_EQ(options.plan.kinds, (std::vector<std::string>{"tight", "load_step"}));
  EXPECT_TRUE(options.json);
}

TEST(EffectsOptions, EffectsAreOfRealisticSizeUnlessFaintOnesAreAskedFor) {
  EXPECT_EQ(read_options({}).plan.size, Size::realistic);
  EXPECT_EQ(read_options({"--faint"}).plan.size, Size::faint);
}

TEST(EffectsOptions, ReadsTheNoiseOfAPlant) {
  EXPECT_EQ(read_options({"--noise", "t5"}).plan.noise, NoiseFamily::t5);
  EXPECT_THROW((void)read_options({"--noise", "loud"}), WrongUsage);
}

/// A run that left an option out would be taken for what it is not.
TEST(EffectsOptions, FieldRecordsAndRecordingsHearNothingOfKindsAndNoise) {
  EXPECT_TRUE(read_options({"--field", "--draws", "3", "--without", "multi_step"}).field);
  EXPECT_EQ(read_options({"--recordings", "list.csv"}).manifest, "list.csv");
  const std::vector<std::vector<std::string>> wrong = {{"--field", "--kinds", "tight"},
                                                       {"--field", "--noise", "t5"},
                                                       {"--recordings", "list.csv", "--faint"},
                                                       {"--field", "--permuted"},
                                                       {"--field", "--json"},
                                                       {"--field", "--residual-tests"},
                                                       {"--field", "--recordings", "list.csv"}};
  for (const auto& words : wrong) EXPECT_THROW((void)read_options(words), WrongUsage) << words[1];
}

TEST(EffectsOptions, ResidualTestsHearNothingOfTheSearch) {
  EXPECT_TRUE(read_options({"--residual-tests", "--kinds", "tight"}).residual_tests);
  for (const char* more : {"--json", "--records", "--permuted"})
    EXPECT_THROW((void)read_options({"--residual-tests", more}), WrongUsage) << more;
  EXPECT_THROW((void)read_options({"--residual-tests", "--without", "play_net"}), WrongUsage);
}

TEST(EffectsOptions, RefusesWhatItDoesNotKnow) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--sed", "7"},     {"--seed"},          {"--seed", "x"},  {"--draws", "0"},
      {"--kinds", "nil"}, {"--dump", "tight"}, {"--seed", "-1"}, {"--threads", "2x"}};
  for (const auto& words : wrong) EXPECT_THROW((void)read_options(words), WrongUsage) << words[0];
}

}  // namespace
}  // namespace loopscope::tests::effects
