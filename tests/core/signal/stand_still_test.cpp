#include "core/signal/stand_still.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::signal {
namespace {

/// A live loop of 1000 samples, whose pv may be made to stand.
struct LiveLoop {
  Samples pv, sp = Samples(1000, 50.0), op;
  std::vector<ControlMode> mode;
  std::optional<PvPast> past;
  LiveLoop() {
    for (int k = 0; k < 1000; ++k) {
      pv.push_back(50.0 + std::sin(0.3 * k) + 0.1 * std::cos(7.0 * k));
      op.push_back(40.0 + std::sin(static_cast<double>(k * k)));  // as good as noise
    }
  }
  void stand(std::size_t first, std::size_t samples, double value) {
    for (std::size_t k = first; k < first + samples; ++k) pv[k] = value;
  }
  [[nodiscard]] RecordedLoop recorded() const { return {pv, sp, op, true, mode, past, 2.0}; }
  [[nodiscard]] std::optional<StandStill> found() const { return find_stand_still(recorded()); }
};

TEST(StandStill, ALiveLoopDoesNot) {
  EXPECT_FALSE(LiveLoop().found());
}

TEST(StandStill, UnderAnErrorWhileOpWorks) {
  LiveLoop loop;
  loop.stand(600, 400, 49.0);
  const auto found = loop.found();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->run.first, 600U);
  EXPECT_EQ(found->run.samples, 400U);
  EXPECT_TRUE(found->to_the_end && found->error_lasts);
  EXPECT_FALSE(found->whole);
  EXPECT_DOUBLE_EQ(found->error, 1.0);
}

TEST(StandStill, AllOfTheWindowToo) {
  LiveLoop loop;
  loop.stand(0, 1000, 49.37);
  ASSERT_TRUE(loop.found());
  EXPECT_TRUE(loop.found()->whole);
}

TEST(StandStill, NotForLessThanThreeHundredSamples) {
  LiveLoop loop;
  loop.stand(701, 299, 49.0);
  EXPECT_FALSE(loop.found());
}

TEST(StandStill, NotInManual) {
  LiveLoop loop;
  loop.stand(600, 400, 49.0);
  loop.mode.assign(1000, ControlMode::manual);
  EXPECT_FALSE(loop.found());
  loop.mode.assign(1000, ControlMode::automatic);
  loop.op.clear();
  EXPECT_TRUE(loop.found()) << "the mode says enough";
  loop.mode.clear();
  EXPECT_FALSE(loop.found()) << "nothing says that anybody asks it to move";
}

TEST(StandStill, NotWhereTheErrorIsLessThanAStepAndOpOnlyNoisy) {
  LiveLoop loop;
  for (double& value : loop.pv) value = std::round(value);
  loop.stand(600, 400, 50.0);
  loop.sp.assign(1000, 50.4);
  EXPECT_FALSE(loop.found());
  for (std::size_t k = 600; k < 1000; ++k) loop.op[k] += 0.05 * static_cast<double>(k - 600);
  EXPECT_TRUE(loop.found()) << "op has gone by 20 % and nothing came of it";
}

TEST(StandStill, TenTimesWhatIsUsual) {
  LiveLoop loop;
  loop.stand(600, 400, 49.0);
  loop.past = PvPast{100.0, 0.01};
  EXPECT_FALSE(loop.found()) << "50 samples of 2 s are usual";
  loop.past = PvPast{70.0, 0.01};
  EXPECT_TRUE(loop.found());
  loop.past.reset();
  loop.stand(100, 45, 50.5);
  loop.stand(200, 120, 50.7);
  EXPECT_TRUE(loop.found()) << "what fails may have failed twice before, and for less long";
  loop.stand(400, 45, 50.9);
  EXPECT_FALSE(loop.found()) << "three runs of 45 and more within the window are usual";
}

TEST(StandStill, NotWhereItHasHadNoTimeToAnswerTheSetpoint) {
  LiveLoop loop;
  loop.stand(0, 900, 50.0);
  const auto step_at = [&](std::size_t from) {
    for (std::size_t k = from; k < 1000; ++k) {
      loop.sp[k] = 53.0;
      loop.op[k] = 55.0;
    }
  };
  step_at(890);
  EXPECT_FALSE(loop.found()) << "calm at its setpoint, and in its dead time";
  step_at(500);
  ASSERT_TRUE(loop.found()) << "no answer for 400 samples";
  EXPECT_EQ(loop.found()->run.samples, 900U);
  for (std::size_t k = 0; k < 1000; ++k) loop.sp[k] = 51.0 + 0.01 * static_cast<double>(k % 7);
  EXPECT_TRUE(loop.found()) << "a setpoint from another controller moves all the time";
}

TEST(StandStill, AControllerThatHasWoundUpIsInAutomatic) {
  LiveLoop loop;
  loop.stand(0, 1000, 49.0);
  loop.op.assign(1000, 100.0);
  ASSERT_TRUE(loop.found());
  loop.op.assign(1000, 60.0);
  EXPECT_FALSE(loop.found()) << "a constant output elsewhere is nobody's answer";
}

TEST(StandStill, ThePastKeepsNeitherWhatStandsNorWhatMayBecomeIt) {
  LiveLoop loop;
  loop.stand(0, 30, 50.7);
  loop.stand(200, 20, 50.5);
  loop.stand(400, 310, 49.5);
  loop.stand(975, 25, 49.0);
  const PvPast past = past_with(loop.recorded());
  EXPECT_DOUBLE_EQ(past.longest_flat_s, 40.0) << "20 samples of 2 s";
  EXPECT_GT(past.step, 0.0);
  loop.past = PvPast{500.0, 1e-6};
  EXPECT_DOUBLE_EQ(past_with(loop.recorded()).longest_flat_s, 0.995 * 500.0) << "fades";
  EXPECT_DOUBLE_EQ(past_with(loop.recorded()).step, 1e-6);
  loop.past.reset();
  loop.mode.assign(1000, ControlMode::manual);
  EXPECT_EQ(past_with(loop.recorded()).longest_flat_s, 0.0) << "a shutdown teaches nothing";
}

TEST(StandStill, AGapAndASecondFailureHideNothing) {
  LiveLoop loop;
  loop.stand(500, 500, 49.0);
  for (std::size_t k = 700; k < 760; ++k) loop.pv[k] = kMissing;
  ASSERT_TRUE(loop.found());
  EXPECT_EQ(loop.found()->run.samples, 500U);
  loop.stand(100, 320, 51.0);
  ASSERT_TRUE(loop.found());
  EXPECT_EQ(loop.found()->run.first, 500U) << "the latest";
  loop.mode.assign(1000, ControlMode::automatic);
  std::fill(loop.mode.begin() + 500, loop.mode.end(), ControlMode::manual);
  ASSERT_TRUE(loop.found());
  EXPECT_EQ(loop.found()->run.first, 100U) << "the other one is in manual";
}

}  // namespace
}  // namespace loopscope::core::signal
