#include "core/diagnosis/loop_model.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::core {
namespace {

signal::LoopWindow window() {
  signal::LoopWindow window;
  for (int k = 0; k < 1000; ++k) {
    window.pv.push_back(std::sin(std::fmod(k * k, 17.0)));
    window.op.push_back(50.0 + std::sin(std::fmod(k * k, 13.0)));
  }
  window.sp.assign(1000, 0.0);
  return window;
}

TEST(LoopModel, TheSwitchLeavesItOut) {
  AnalysisSettings settings;
  settings.fit_model = false;
  EXPECT_FALSE(diagnose(window(), settings).evidence.model.has_value());
}

TEST(LoopModel, NoModelOfDataThatCannotBeJudged) {
  signal::LoopWindow constant = window();
  constant.pv.assign(1000, 1.0);
  EXPECT_FALSE(diagnose(constant, {}).evidence.model.has_value());
}

}  // namespace
}  // namespace loopscope::core
