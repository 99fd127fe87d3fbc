#include "core/plant/cascade.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "core/hos/numeric/normal_draw.hpp"

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kSamples = 2048;

/// A master whose output wanders, and a slave that is told so, at their own intervals.
struct Cascade {
  std::vector<double> master_op, master_error, slave_sp, slave_error;
  MemberLoop master, slave;

  /// The output moves every `scan` seconds; the setpoint is 30 + 0.8 op, `late` seconds later.
  Cascade(double master_interval, double slave_interval, std::uint64_t seed, double late = 0.0) {
    std::mt19937_64 random(seed);
    constexpr std::size_t kSeconds = 60'000;
    std::vector<double> op{50.0};
    for (std::size_t t = 1; t < kSeconds; ++t)
      op.push_back(50.0 + 0.97 * (op.back() - 50.0) + hos::normal_draw(random));
    for (std::size_t k = 0; k < kSamples; ++k) {
      const auto now = [&](double interval) {
        return static_cast<std::size_t>(static_cast<double>(kSeconds - 1) -
                                        static_cast<double>(kSamples - 1 - k) * interval);
      };
      master_op.push_back(op[now(master_interval)]);
      slave_sp.push_back(30.0 + 0.8 * op[now(slave_interval) - static_cast<std::size_t>(late)]);
      master_error.push_back(hos::normal_draw(random));
      slave_error.push_back(hos::normal_draw(random));
    }
    master = loop_of(master_interval, master_error);
    master.op = master_op;
    slave = loop_of(slave_interval, slave_error);
    slave.sp = slave_sp;
  }

 private:
  static MemberLoop loop_of(double interval, const std::vector<double>& error) {
    MemberLoop loop;
    loop.sample_interval_s = interval;
    loop.start_us = -std::llround(static_cast<double>(kSamples - 1) * interval * 1e6);
    loop.error = error;
    return loop;
  }
};

TEST(Cascade, FindsThePairWhateverTheSampling) {
  for (const auto& [master, slave] :
       {std::pair{5.0, 5.0}, {10.0, 1.0}, {1.0, 10.0}, {15.0, 2.0}, {15.0, 10.0}}) {
    const Cascade cascade(master, slave, 3);
    const std::vector<MemberLoop> loops{cascade.slave, cascade.master};
    const std::vector<CascadePair> pairs = find_cascade_pairs(loops);
    ASSERT_EQ(pairs.size(), 1U) << master << " s, " << slave << " s";
    EXPECT_EQ(pairs.front().master, 1U);
    EXPECT_EQ(pairs.front().slave, 0U);
    EXPECT_NEAR(pairs.front().correlation, 1.0, 1e-9);
    EXPECT_EQ(pairs.front().lag_s, 0.0);
  }
}

TEST(Cascade, AllowsForALateSetpointOrOutput) {
  for (const double late : {5.0, 10.0}) {
    const Cascade cascade(5.0, 5.0, 4, late);
    const std::vector<MemberLoop> loops{cascade.master, cascade.slave};
    const std::vector<CascadePair> pairs = find_cascade_pairs(loops);
    ASSERT_EQ(pairs.size(), 1U) << late;
    EXPECT_NEAR(pairs.front().lag_s, late, 1e-9);
  }
  const Cascade late(5.0, 5.0, 4, 20.0);
  EXPECT_TRUE(find_cascade_pairs(std::vector{late.master, late.slave}).empty());
}

TEST(Cascade, LikeWanderingLoopsAreNoPairs) {
  std::vector<Cascade> cascades;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) cascades.emplace_back(5.0, 5.0, seed);
  std::vector<MemberLoop> loops;
  for (std::size_t k = 0; k + 1 < cascades.size(); ++k) {
    loops.push_back(cascades[k].slave);
    loops.push_back(cascades[k + 1].master);
  }
  // Every slave is told by the master before it; 29 of the 841 pairs are real but one has no slave.
  for (const CascadePair& pair : find_cascade_pairs(loops)) EXPECT_EQ(pair.slave, pair.master + 1);
  EXPECT_EQ(find_cascade_pairs(loops).size(), 28U);
}

TEST(Cascade, SetpointStepsByHandAreNoCascade) {
  Cascade cascade(5.0, 5.0, 5);
  std::vector<double> held(kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) held[k] = cascade.master_op[k - k % 50];
  cascade.slave.sp = held;
  EXPECT_TRUE(find_cascade_pairs(std::vector{cascade.master, cascade.slave}).empty());
}

TEST(Cascade, LoopsWithoutSetpointOrOutputAreLeftOut) {
  Cascade cascade(5.0, 5.0, 6);
  cascade.master.op = {};
  EXPECT_TRUE(find_cascade_pairs(std::vector{cascade.master, cascade.slave}).empty());
  EXPECT_TRUE(find_cascade_pairs({}).empty());
}

}  // namespace
}  // namespace loopscope::core::plant
