#include "core/signal/op_range.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::core::signal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Between two values, neither of which is a whole number's neighbour.
Samples between(double low, double high) {
  Samples op;
  for (int k = 0; k < 600; ++k)
    op.push_back(0.5 * (low + high) + 0.5 * (high - low) * std::sin(0.37 * k));
  return op;
}

OpRange inferred(const Samples& op) {
  const KnownRange found = find_op_range(op, std::nullopt);
  EXPECT_EQ(found.source, RangeSource::inferred);
  return found.range.value_or(OpRange{-1.0, -1.0});
}

TEST(OpRange, TheUsualOnesAreInferred) {
  EXPECT_EQ(range_text(inferred(between(0.4, 0.6))), "0 to 1");
  EXPECT_EQ(range_text(inferred(between(0.0, 1.0))), "0 to 1");
  EXPECT_EQ(range_text(inferred(between(30.0, 60.0))), "0 to 100");
  EXPECT_EQ(range_text(inferred(between(-2.0, 103.0))), "0 to 100") << "overrange";
  EXPECT_EQ(range_text(inferred(between(4.5, 19.0))), "4 to 20") << "most of it";
  EXPECT_EQ(range_text(inferred(between(8.0, 12.0))), "0 to 100") << "a percentage as well";
  Samples counts = between(3000.0, 20000.0);
  for (double& value : counts) value = std::round(value);
  EXPECT_EQ(range_text(inferred(counts)), "0 to 27648");
}

TEST(OpRange, AnOutputThatRestsAtTwentyIsACurrent) {
  Samples op = between(12.0, 19.0);
  for (std::size_t k = 100; k < 150; ++k) op[k] = 20.0;
  EXPECT_EQ(range_text(inferred(op)), "4 to 20");
  for (double& value : op) value = std::round(value);
  EXPECT_EQ(range_text(inferred(op)), "0 to 100") << "whole percents rest everywhere";
}

TEST(OpRange, OtherUnitsAreUnknown) {
  EXPECT_EQ(find_op_range(between(300.3, 500.7), std::nullopt).source, RangeSource::unknown);
  EXPECT_EQ(find_op_range(Samples{}, std::nullopt).source, RangeSource::unknown);
}

TEST(OpRange, WhatWasSetHoldsUnlessTheValuesContradictIt) {
  const OpRange set{0.0, 100.0};
  const KnownRange held = find_op_range(between(40.0, 60.0), set);
  EXPECT_EQ(held.source, RangeSource::set);
  EXPECT_THAT(held.doubt, IsEmpty());
  const KnownRange share = find_op_range(between(0.4, 0.6), set);
  EXPECT_EQ(share.source, RangeSource::inferred);
  EXPECT_EQ(share.range->high, 1.0);
  EXPECT_EQ(share.doubt, "op never leaves 0 to 1 of 0 to 100");
  EXPECT_THAT(find_op_range(between(0.0, 4000.5), set).doubt, HasSubstr("beyond 0 to 100"));
  EXPECT_EQ(find_op_range(Samples(600, 0.0), set).source, RangeSource::set) << "a closed valve";
  Samples shut = between(-0.3, 0.4);
  for (double& value : shut) value = std::max(value, 0.0);
  EXPECT_EQ(find_op_range(shut, set).source, RangeSource::set)
      << "one that is shut most of the time";
  EXPECT_EQ(find_op_range(between(5.0, 18.0), set).source, RangeSource::set) << "5 to 18 %";
  Samples bad = between(40.0, 60.0);
  bad[7] = 150.0;
  EXPECT_EQ(find_op_range(bad, set).source, RangeSource::set) << "one bad value";
}

}  // namespace
}  // namespace loopscope::core::signal
