#include "core/diagnosis/plant_member.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace loopscope::core::diagnosis {
namespace {

TEST(PlantMember, SumsTheStepsByWhatTheyBlame) {
  Evidence evidence;
  evidence.model.emplace();
  const auto step = [](model::EffectKind effect, double before, double after) {
    model::Step taken;
    taken.effect = effect;
    taken.holdout_error_before = before;
    taken.holdout_error_after = after;
    return taken;
  };
  evidence.model->steps = {step(model::EffectKind::external_oscillation, 8.0, 4.0),
                           step(model::EffectKind::valve_stiction, 4.0, 2.0),
                           step(model::EffectKind::valve_deadband, 2.0, 1.0),
                           step(model::EffectKind::load_step, 1.0, 0.5)};
  Verdict verdict;
  verdict.code = VerdictCode::valve_stiction;
  verdict.confidence = 0.8;
  for (const auto& [code, probability] :
       {std::pair(VerdictCode::valve_stiction, 0.8), std::pair(VerdictCode::valve_deadband, 0.5),
        std::pair(VerdictCode::valve_saturation, 0.7),
        std::pair(VerdictCode::external_disturbance, 0.3)}) {
    verdict.causes.emplace_back();
    verdict.causes.back().code = code;
    verdict.causes.back().probability = probability;
  }
  const plant::OwnFindings own = own_findings(evidence, verdict);
  EXPECT_NEAR(own.outside_explained, std::log(2.0), 1e-12);
  EXPECT_NEAR(own.valve_explained, std::log(4.0), 1e-12);
  EXPECT_NEAR(own.other_explained, std::log(2.0), 1e-12);
  EXPECT_EQ(own.fault, plant::Fault::friction);
  EXPECT_EQ(own.confidence, 0.8);
  EXPECT_NEAR(own.friction_p, 0.9, 1e-12) << "one of the two, or both";
  EXPECT_NEAR(own.outside_p, 0.3, 1e-12);
  EXPECT_FALSE(own.nonlinear_p.has_value());
}

TEST(PlantMember, WithoutAModelOnlyTheVerdictSpeaks) {
  const plant::OwnFindings own = own_findings(Evidence{}, Verdict{});
  EXPECT_EQ(own.valve_explained, 0.0);
  EXPECT_EQ(own.fault, plant::Fault::none);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
