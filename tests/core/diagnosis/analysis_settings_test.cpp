#include "core/diagnosis/analysis_settings.hpp"

#include <gtest/gtest.h>

namespace loopscope::core {
namespace {

TEST(LoopFacts, LevelLoopsIntegrate) {
  for (const char* type : {"level", "Level", " LEVEL\t"}) EXPECT_TRUE(is_integrating_type(type));
  for (const char* type : {"", "flow", "levels", "le vel"}) EXPECT_FALSE(is_integrating_type(type));
}

}  // namespace
}  // namespace loopscope::core
