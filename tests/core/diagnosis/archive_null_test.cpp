#include "core/diagnosis/archive_null.hpp"

#include <gtest/gtest.h>
#include <random>

namespace loopscope::core {
namespace {

signal::Samples noise() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  signal::Samples samples;
  for (int k = 0; k < 1024; ++k) samples.push_back(normal(random));
  return samples;
}

hos::Result result_with(double p) {
  hos::Result result;
  result.ngi_p = result.nli_p = result.cubic_p = result.nonlinear_p = p;
  return result;
}

TEST(ArchiveNull, WhatDecidesNothingStaysAsItIs) {
  hos::Result result = result_with(0.2);
  allow_for_door(noise(), 0.5, {}, 1, result);
  EXPECT_EQ(*result.nonlinear_p, 0.2);
}

TEST(ArchiveNull, NoPValueFallsAndTheSeedDecides) {
  hos::Result first = result_with(1e-3);
  hos::Result second = result_with(1e-3);
  allow_for_door(noise(), 0.5, {}, 1, first);
  allow_for_door(noise(), 0.5, {}, 1, second);
  EXPECT_GE(*first.cubic_p, 1e-3);
  EXPECT_GE(*first.nonlinear_p, 1e-3);
  EXPECT_EQ(*first.nonlinear_p, *second.nonlinear_p);
}

TEST(ArchiveNull, WhatIsMissingStaysMissing) {
  hos::Result result = result_with(1e-3);
  result.cubic_p.reset();
  allow_for_door(noise(), 0.5, {}, 1, result);
  EXPECT_FALSE(result.cubic_p.has_value());
}

}  // namespace
}  // namespace loopscope::core
