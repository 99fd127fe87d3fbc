#include "daemon/setup/row_contents.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

QualityGuess guess_of(const std::string& type, const storage::CountedTexts& codes,
                      const std::string& name = "quality") {
  return guess_quality({name, type, ""}, codes);
}

TEST(RowContents, QualityByTheCodesThatWereSeen) {
  EXPECT_EQ(guess_of("int2", {{"192", 90}, {"0", 3}, {"64", 1}}).rule, "opcda");
  EXPECT_EQ(guess_of("int4", {{"216", 90}}).rule, "opcda");
  EXPECT_EQ(guess_of("int4", {{"262336", 90}, {"192", 3}}).rule, "opchda");
  EXPECT_EQ(guess_of("int8", {{"0", 90}, {"2147483648", 1}}).rule, "opcua");
  EXPECT_EQ(guess_of("int4", {{"0", 90}, {"-2147483648", 1}}).rule, "opcua");
  EXPECT_EQ(guess_of("int4", {{"0", 90}}).rule, "zero");
  EXPECT_EQ(guess_of("int4", {{"0", 90}, {"3", 1}}).rule, "zero");
  EXPECT_EQ(guess_of("int8", {{"0", 90}}, "StatusCode").rule, "opcua");
  EXPECT_EQ(guess_of("bool", {{"t", 90}}).rule, "truth");
}

TEST(RowContents, QualityOfOneAndZeroIsGoodAndBad) {
  const QualityGuess guess = guess_of("int2", {{"1", 90}, {"0", 3}});
  EXPECT_EQ(guess.rule, "codes");
  EXPECT_THAT(guess.good_codes, ElementsAre("1"));
  EXPECT_THAT(guess.bad_codes, ElementsAre("0"));
  EXPECT_EQ(guess.note, "");
}

TEST(RowContents, QualityInWords) {
  const QualityGuess guess =
      guess_of("text", {{"OK (0x0)", 90}, {"Bad", 3}, {"Uncertain", 2}, {"GOOD", 1}});
  EXPECT_EQ(guess.rule, "codes");
  EXPECT_THAT(guess.good_codes, ElementsAre("OK (0x0)", "GOOD"));
  EXPECT_THAT(guess.uncertain_codes, ElementsAre("Uncertain"));
  EXPECT_THAT(guess.bad_codes, ElementsAre("Bad"));
}

TEST(RowContents, CodesOfNobodyAreSaidToBeReviewed) {
  const QualityGuess numbers = guess_of("int2", {{"7", 90}, {"3", 3}});
  EXPECT_THAT(numbers.good_codes, ElementsAre("7"));
  EXPECT_EQ(numbers.note,
            "quality codes seen: 7, 3; 7 is the commonest and counts as good: review good_codes");
  EXPECT_THAT(guess_of("text", {{"A", 90}}).note, HasSubstr("review good_codes"));
  EXPECT_THAT(guess_of("int2", {}).note, HasSubstr("no row has a quality yet"));
  EXPECT_EQ(guess_of("text", {}).rule, "none");
}

TEST(RowContents, UnitsOfTimesByTheirSize) {
  EXPECT_EQ(guess_epoch({{"1772323200", 1}}).kind, "epoch_s");
  EXPECT_EQ(guess_epoch({{"1772323200000", 1}}).kind, "epoch_ms");
  EXPECT_EQ(guess_epoch({{"1772323200000000", 1}}).kind, "epoch_us");
  EXPECT_EQ(guess_epoch({{"1772323200000000000", 1}}).kind, "epoch_ns");
  EXPECT_THAT(guess_epoch({}).note, HasSubstr("no row"));
}

TEST(RowContents, TimesAheadOfUtcAreLocal) {
  EXPECT_EQ(guess_zone(30.0).kind, "timestamp_utc");
  EXPECT_EQ(guess_zone(30.0).note, "");
  EXPECT_EQ(guess_zone(-7190.0).kind, "timestamp_local");
  EXPECT_THAT(guess_zone(-7190.0).note, HasSubstr("2.0 h ahead of UTC"));
  EXPECT_EQ(guess_zone(18030.0).kind, "timestamp_utc") << "five hours west, or five hours dead";
  EXPECT_THAT(guess_zone(18030.0).note, HasSubstr("5.0 h behind UTC"));
  EXPECT_EQ(guess_zone(1e6).note, "") << "an old recording";
  EXPECT_THAT(guess_zone(std::nullopt).note, HasSubstr("could not be seen"));
}

}  // namespace
}  // namespace loopscope::daemon
