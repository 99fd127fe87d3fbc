#include "core/signal/control_state.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::signal {
namespace {

TEST(ModeCounts, CascadeIsAutomaticAndUnknownIsNotKnown) {
  const std::vector<ControlMode> mode{ControlMode::manual, ControlMode::automatic,
                                      ControlMode::cascade, ControlMode::unknown};
  const ModeCounts counts = count_modes(mode);
  EXPECT_EQ(counts.manual, 1U);
  EXPECT_EQ(counts.automatic, 2U);
  EXPECT_EQ(counts.unknown, 1U);
  EXPECT_EQ(counts.known(), 3U);
}

TEST(ModeCounts, NothingIsKnownOfNothing) {
  EXPECT_EQ(count_modes({}).known(), 0U);
}

struct OpenLoop {
  Samples op, error;
  std::vector<ControlMode> mode;
  RangeSource range = RangeSource::set;
  OpenLoop() {
    for (int k = 0; k < 1000; ++k) {
      error.push_back(std::sin(0.3 * k));
      op.push_back(40.0 + std::cos(0.3 * k));
    }
  }
  void hold(std::size_t first, double value) {
    for (std::size_t k = first; k < op.size(); ++k) op[k] = value;
  }
  [[nodiscard]] ControlState state() const { return find_control_state({op, error, mode, range}); }
};

TEST(ControlState, AControllerThatMovesItsOutputActs) {
  const ControlState state = OpenLoop().state();
  EXPECT_TRUE(state.controlling());
  EXPECT_EQ(state.acting_fraction, 1.0);
  EXPECT_EQ(state.reason, NotActing::none);
  EXPECT_FALSE(state.lost_at || state.held_at_limit || state.wound_up_percent);
}

TEST(ControlState, TheModeSaysSo) {
  OpenLoop loop;
  loop.mode.assign(1000, ControlMode::manual);
  for (std::size_t k = 0; k < 300; ++k) loop.mode[k] = ControlMode::automatic;
  const ControlState state = loop.state();
  EXPECT_FALSE(state.controlling());
  EXPECT_EQ(state.reason, NotActing::mode);
  EXPECT_EQ(state.lost_at, 300U);
  EXPECT_DOUBLE_EQ(*state.acting_fraction, 0.3);
}

TEST(ControlState, WithoutAModeAConstantOutputDoes) {
  OpenLoop loop;
  loop.hold(0, 43.0);
  EXPECT_FALSE(loop.state().controlling());
  EXPECT_EQ(loop.state().reason, NotActing::constant_output);
  EXPECT_EQ(loop.state().lost_at, 0U);
  loop.mode.assign(1000, ControlMode::automatic);
  EXPECT_FALSE(loop.state().controlling()) << "whatever the mode says";
}

TEST(ControlState, AndOneThatStandsWhereItUsuallyDoesNot) {
  OpenLoop loop;
  loop.hold(400, 43.0);
  EXPECT_FALSE(loop.state().controlling());
  EXPECT_EQ(loop.state().lost_at, 400U);
  loop = OpenLoop();
  loop.hold(720, 43.0);
  EXPECT_TRUE(loop.state().controlling()) << "280 samples are no stretch";
}

TEST(ControlState, AndOneThatAnOperatorMovesNowAndThen) {
  OpenLoop loop;
  for (std::size_t k = 0; k < 1000; ++k) {
    const std::size_t moved = k / 330;
    loop.op[k] = 40.0 + 2.0 * static_cast<double>(moved);
  }
  EXPECT_FALSE(loop.state().controlling());
}

TEST(ControlState, WhateverAModeThatSaysAutomatic) {
  OpenLoop loop;
  loop.mode.assign(1000, ControlMode::automatic);
  loop.hold(400, 43.0);
  EXPECT_FALSE(loop.state().controlling()) << "an output that usually moves stands";
  EXPECT_EQ(loop.state().reason, NotActing::constant_output);
  EXPECT_EQ(loop.state().lost_at, 400U);
  const Samples moving = loop.error;
  std::fill(loop.error.begin() + 405, loop.error.end(), 0.0);
  EXPECT_TRUE(loop.state().controlling()) << "nothing is asked of it";
  loop.error = moving;
  loop.range = RangeSource::unknown;
  for (double& error : loop.error) error += 2.0;
  EXPECT_TRUE(loop.state().controlling()) << "it may be at its end";
}

TEST(ControlState, AnOutputWhoseReadingFlickersStands) {
  OpenLoop loop;
  loop.mode.assign(1000, ControlMode::automatic);
  const auto flickers = [&](auto high) {
    for (int k = 0; k < 1000; ++k) loop.op[static_cast<std::size_t>(k)] = high(k) ? 43.1 : 43.0;
  };
  flickers([](int k) { return std::sin(static_cast<double>(k) * k) > 0.0; });
  EXPECT_FALSE(loop.state().controlling());
  EXPECT_EQ(loop.state().lost_at, 0U);
  for (double& op : loop.op) op = 43.0 + 20.0 * (op - 43.0);
  EXPECT_TRUE(loop.state().controlling()) << "2 % are more than a reading";
  flickers([](int k) { return std::sin(0.3 * k) > 0.0; });
  EXPECT_TRUE(loop.state().controlling()) << "it follows the error";
  flickers([](int k) { return k % 100 == 0; });
  EXPECT_TRUE(loop.state().controlling()) << "too few moves to tell";
}

TEST(ControlState, AnOutputAtItsEndUnderALastingErrorIsAController) {
  for (const double end : {0.0, 100.0}) {
    OpenLoop loop;
    loop.range = RangeSource::inferred;
    loop.hold(0, end);
    EXPECT_FALSE(loop.state().controlling()) << "the error comes and goes";
    loop.error.assign(1000, 2.0);
    const ControlState state = loop.state();
    EXPECT_TRUE(state.controlling() && state.held_at_limit);
    EXPECT_EQ(state.wound_up_percent, end);
    EXPECT_EQ(state.at_limit_fraction, 1.0);
  }
}

TEST(ControlState, NothingRecordedTellsNothing) {
  OpenLoop loop;
  loop.op.clear();
  EXPECT_FALSE(loop.state().acting_fraction);
  EXPECT_TRUE(loop.state().controlling());
}

}  // namespace
}  // namespace loopscope::core::signal
