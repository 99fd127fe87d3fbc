#include "core/diagnosis/model_words.hpp"

#include <gmock/gmock.h>
#include <limits>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

TEST(ModelWords, WhatIsLeftIsToldWhereAnythingIs) {
  model::Explanation explanation = explanation_of();
  explanation.unexplained = {};
  explanation.unexplained.whiteness_p = 0.31;
  explanation.unexplained.fraction = 0.004;
  EXPECT_EQ(left_text(explanation),
            "The model explains all of the explainable error (residual whiteness p 0.31).");
  explanation.unexplained.whiteness_p = 0.0075;
  EXPECT_EQ(left_text(explanation),
            "The model explains nearly all of the explainable error, but its residual is not white "
            "(p 0.0075).");
  explanation.unexplained.whiteness_p = 0.31;
  explanation.unexplained.fraction = 0.09;
  EXPECT_EQ(
      left_text(explanation),
      "The model leaves 9 % of the explainable error unexplained (residual whiteness p 0.31).");
}

TEST(ModelWords, AModelThatIsNotEnoughIsRough) {
  model::Explanation explanation = explanation_of();
  explanation.unexplained.fraction = 0.6;
  EXPECT_THAT(left_text(explanation),
              testing::EndsWith("It describes the loop in part only: take its figures as rough."));
  explanation.error_kind = model::ErrorKind::simulation;
  EXPECT_THAT(left_text(explanation), testing::EndsWith(")."))
      << "of a simulated cycle what is left is an upper bound";
}

/// As of a loop whose scored half is the noisier one: 0.123 on both halves, 0.129 on that one.
TEST(ModelWords, AFloorAboveTheErrorIsExplained) {
  model::Explanation explanation =
      explanation_of({clear_step(model::EffectKind::valve_stiction, 0.13, 0.123)});
  explanation.noise_floor = 0.129;
  explanation.unexplained.fraction = 0.0;
  EXPECT_EQ(floor_text(explanation),
            "The noise floor stands above the last error because it is measured on one half of the "
            "samples only, the noisier one, and the errors of the effects on both. On the same "
            "samples the model reaches the floor.");
  explanation.unexplained.fraction = 0.25;
  EXPECT_THAT(floor_text(explanation),
              testing::EndsWith("the model leaves 25 % of what lies above the floor."));
  for (const double floor : {0.12, 0.12300001, std::numeric_limits<double>::quiet_NaN()}) {
    explanation.noise_floor = floor;
    EXPECT_EQ(floor_text(explanation), "") << floor;
  }
  EXPECT_EQ(floor_text(explanation_of()), "");
}

TEST(ModelWords, WhatTheEffectsTakeOffTogether) {
  EXPECT_EQ(effects_text(explanation_of({clear_step(model::EffectKind::valve_stiction, 1.0, 0.5),
                                         clear_step(model::EffectKind::load_step, 0.5, 0.4)})),
            "The effects take 60 % off the error of the linear model; how sure they are is what "
            "evidence and p say.");
  EXPECT_EQ(effects_text(explanation_of()), "");
  EXPECT_EQ(
      effects_text(explanation_of({clear_step(model::EffectKind::sensor_quantisation, 1.0, 1.0)})),
      "");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
