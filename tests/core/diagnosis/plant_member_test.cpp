#include "core/diagnosis/plant_member.hpp"

#include <gtest/gtest.h>
#include <utility>

namespace loopscope::core::diagnosis {
namespace {

TEST(PlantMember, TakesTheCausesTogetherThatTellNeighboursTheSame) {
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
  const plant::OwnFindings own = own_findings(verdict);
  EXPECT_EQ(own.fault, plant::Fault::friction);
  EXPECT_EQ(own.confidence, 0.8);
  EXPECT_NEAR(own.friction_p, 0.9, 1e-12) << "one of the two, or both";
  EXPECT_NEAR(own.outside_p, 0.3, 1e-12);
}

TEST(PlantMember, WhereNothingWasWeighedNothingIsSaid) {
  const plant::OwnFindings own = own_findings(Verdict{});
  EXPECT_EQ(own.fault, plant::Fault::none);
  EXPECT_EQ(own.friction_p, 0.0);
  EXPECT_EQ(own.outside_p, 0.0);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
