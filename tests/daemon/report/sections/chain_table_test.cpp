#include "daemon/report/sections/chain_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using core::model::EffectKind;
using testing::HasSubstr;

core::model::Explanation two_steps(const std::string& saw) {
  core::model::Explanation told;
  told.excited = true;
  core::model::Step stiction;
  stiction.effect = EffectKind::valve_stiction;
  stiction.parameters = {{"S", "%", 5.0, 4.5, 5.5}};
  stiction.law = "kano";
  stiction.holdout_error_before = 0.125;
  stiction.holdout_error_after = 0.0625;
  stiction.asked_by = {{"op_direction", 0.0, 0.31, saw}, {"op_level", 0.004, {}, ""}};
  core::model::Step wave;
  wave.effect = EffectKind::external_oscillation;
  wave.holdout_error_before = 0.0625;
  wave.holdout_error_after = 0.05;
  told.steps = {stiction, wave};
  return told;
}

std::vector<StepPictures> of_the_second() {
  return {{1, {"", "before", "<svg width=\"5\"/>", 440, 170}, {"", "after", "<svg/>", 440, 170}}};
}

TEST(ChainTable, LeadsFromTheTestThatSpokeToWhatItSaysAfterwards) {
  const std::string table = chain_table(two_steps("It depends on op's last turn."), {}).html;
  EXPECT_THAT(table, HasSubstr("<b>op direction</b> p &lt; 1e-12<small>It depends on op"));
  EXPECT_THAT(table, HasSubstr("<b>op level</b> p = 0.004</p>"));
  EXPECT_THAT(table, HasSubstr("<b>valve stiction</b><small>S 5 % (4.5 to 5.5); law kano"));
  EXPECT_THAT(table, HasSubstr("<p>error 0.125</p>"));
  EXPECT_THAT(table, HasSubstr("<p>error 0.0625, op direction p = 0.31</p>"))
      << "op_level was not asked again";
  EXPECT_EQ(unbalanced(table), "");
}

TEST(ChainTable, AStepThatNoTestAskedForSaysSo) {
  EXPECT_THAT(chain_table(two_steps(""), {}).html,
              HasSubstr("no residual test: a first screening"));
}

TEST(ChainTable, PicturesStandInTheRowOfTheirStep) {
  const std::string table = chain_table(two_steps(""), of_the_second()).html;
  const std::size_t second = table.find("external oscillation");
  ASSERT_NE(second, std::string::npos);
  EXPECT_GT(table.find("<img"), table.find("valve stiction")) << "the first step has none";
  EXPECT_LT(table.find("alt=\"before\""), second);
  EXPECT_GT(table.find("alt=\"after\""), second);
  EXPECT_EQ(unbalanced(table), "");
}

TEST(ChainTable, NothingTakenInIsNoTable) {
  core::model::Explanation told = two_steps("");
  told.excited = false;
  EXPECT_EQ(chain_table(told, {}).html, "");
  told.excited = true;
  told.steps.clear();
  EXPECT_EQ(chain_table(told, {}).html, "");
}

TEST(ChainTable, NoHostileWordsChangeTheMarkup) {
  const auto plain = tags_of(chain_table(two_steps("words"), of_the_second()).html);
  for (const auto& [about, name] : tests::hostile_names())
    EXPECT_EQ(tags_of(chain_table(two_steps(name), of_the_second()).html), plain)
        << about << ": " << name;
}

}  // namespace
}  // namespace loopscope::daemon
