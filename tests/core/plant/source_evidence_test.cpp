#include "core/plant/source_evidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::core::plant {
namespace {

using testing::ElementsAre;

TEST(SourceReasons, WhatSpeaksForTheLoopStandsFirst) {
  SourceEvidence evidence;
  evidence.strength = 0.72;
  evidence.op_share = 0.4;
  const std::string shares =
      "The oscillation is 72 % of its error's variance and 40 % of its output's.";
  EXPECT_THAT(reasons_of(evidence), ElementsAre(shares));
  evidence.net_lead = 0.35;
  evidence.friction_p = 0.8;
  EXPECT_THAT(reasons_of(evidence),
              ElementsAre("Its past predicts the others better than theirs predicts it (35 % of "
                          "the predicted variance, net).",
                          "By its own diagnosis its valve sticks, has dead band or is oversized, "
                          "probability 80 %.",
                          shares));
}

TEST(SourceReasons, WhatSpeaksAgainstItIsCalledSo) {
  SourceEvidence evidence;
  evidence.net_lead = -0.12;
  evidence.outside_p = 0.6;
  evidence.writes_setpoint = true;
  EXPECT_THAT(
      reasons_of(evidence),
      ElementsAre("The oscillation is 0 % of its error's variance and 0 % of its output's.",
                  "Its output is another loop's setpoint: it moves no valve of its own.",
                  "Against it: the others' past predicts it better than its past predicts them "
                  "(12 %, net).",
                  "Against it: by its own diagnosis something outside the loop disturbs it, "
                  "probability 60 %."));
}

}  // namespace
}  // namespace loopscope::core::plant
