#include "daemon/catalogue/tag_pattern.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

const std::vector<std::string> kWords{"auto", "meas", "op", "pv", "sp"};

/// "loop word" of a tag, "-" when it does not fit.
std::string taken_apart(const std::string& pattern, const std::string& tag) {
  const auto match = TagPattern(pattern).match(tag, kWords);
  return match ? match->loop + " " + match->word : "-";
}

TEST(TagPattern, TakesTheUsualNamesApart) {
  EXPECT_EQ(taken_apart("{loop}.{role}", "FIC101.SP"), "FIC101 SP");
  EXPECT_EQ(taken_apart("{loop}/{role}", "FIC101/PV"), "FIC101 PV");
  EXPECT_EQ(taken_apart("{loop}/{role}", "area1/FIC101/pv"), "area1/FIC101 pv");
  EXPECT_EQ(taken_apart("{loop}_{role}", "FIC_101_Meas"), "FIC_101 Meas");
  EXPECT_EQ(taken_apart("{role}_{loop}", "PV_FIC101"), "FIC101 PV");
  EXPECT_EQ(taken_apart("{loop}{role}", "FIC101PV"), "FIC101 PV");
  EXPECT_EQ(taken_apart("{loop}[./_]{role}", "FIC101_OP"), "FIC101 OP");
  EXPECT_EQ(taken_apart("DCS:{loop}.{role}", "dcs:FIC101.OP"), "FIC101 OP");
}

TEST(TagPattern, AStarIsOnePartOfTheName) {
  EXPECT_EQ(taken_apart("{loop}/*/{role}.CV", "FIC101/PID1/PV.CV"), "FIC101 PV");
  EXPECT_EQ(taken_apart("{loop}/*/{role}.CV", "FIC101/PV.CV"), "-");
  EXPECT_EQ(taken_apart("{loop}/*/{role}.CV", "U1/FIC101/PID1/PV.CV"), "U1/FIC101 PV");
  EXPECT_EQ(taken_apart("{loop}.PID*.{role}", "FIC101.PIDA.OP"), "FIC101 OP");
  EXPECT_EQ(taken_apart("{loop}.PID*.{role}", "FIC101.PID.OP"), "FIC101 OP");
  EXPECT_EQ(taken_apart("{loop}.PID*.{role}", "FIC101.DACA.OP"), "-");
}

TEST(TagPattern, TheWholeTagHasToFit) {
  EXPECT_EQ(taken_apart("{loop}.{role}", "FIC101.PVX"), "-");
  EXPECT_EQ(taken_apart("{loop}.{role}", ".PV"), "-") << "a loop has a name";
  EXPECT_EQ(taken_apart("{loop}.{role}", "PV"), "-");
  EXPECT_EQ(taken_apart("{loop}.{role}", ""), "-");
  EXPECT_EQ(taken_apart("{loop}.{role}", "FIC101.PV.OP"), "FIC101.PV OP") << "as long as possible";
}

TEST(TagPattern, SaysWhatIsWrongWithIt) {
  for (const char* text : {"", "{loop}", "{role}", "{loop}{loop}{role}", "{loop}.{rolle}",
                           "{loop}[.{role}", "{loop}[]{role}"}) {
    EXPECT_THROW(TagPattern{text}, std::invalid_argument) << text;
  }
}

TEST(TagPattern, LongTagsCostNoMoreThanTheirLength) {
  const std::string tag(100'000, 'x');
  EXPECT_EQ(taken_apart("{loop}[./_]{role}", tag), "-");
}

TEST(TagPattern, ManyStarsCostNoMoreThanTheirNumber) {
  // The ways to share 500 characters out among 20 stars are more than can be tried.
  const std::string tag(500, 'x');
  EXPECT_EQ(taken_apart("{loop}********************.{role}", tag), "-");
  EXPECT_EQ(taken_apart("{loop}********************.{role}", tag + ".PV"), tag + " PV");
}

}  // namespace
}  // namespace loopscope::daemon
