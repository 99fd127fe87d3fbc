#include "core/model/controller/excitation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/simulate/random.hpp"
#include "tests/core/model/known_loops.hpp"

namespace loopscope::core::model {
namespace {

using known::Records;
using known::Series;

Excitation judge(const Records& records, bool in_percent = true) {
  return judge_excitation({records.op, records.pv, in_percent, {}});
}

/// x(k) = memory x(k-1) + size w(k)
Series wandering(std::uint64_t seed, double memory, double size, double level = 0.0) {
  simulate::GaussianSource noise(seed);
  Series series(4096);
  double value = 0.0;
  for (double& sample : series) {
    value = memory * value + size * noise.next();
    sample = level + value;
  }
  return series;
}

TEST(Excitation, LoopsThatWorkAreExcited) {
  for (const char* name : {"healthy_flow", "paper_5_1", "paper_5_4_kano", "level_loop", "deadband",
                           "sluggish_tuning", "tight_tuning", "worn_valve", "load_upsets"}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Excitation found = judge(known::run(known::scenario(name).settings, seed));
      EXPECT_TRUE(found.sufficient) << name << ": " << found.statement;
    }
  }
}

TEST(Excitation, SmallLimitCycleOfALargeValveIsEnough) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Excitation found = judge(known::run(known::scenario("oversized_valve").settings, seed));
    EXPECT_LT(found.op_span, 0.6);
    EXPECT_TRUE(found.sufficient) << found.statement;
  }
}

TEST(Excitation, ConstantAndMissingOpAreNot) {
  Records records = known::run(known::scenario("healthy_flow").settings, 1);
  records.op.assign(records.op.size(), 40.0);
  EXPECT_FALSE(judge(records).sufficient);
  EXPECT_EQ(judge(records).statement, "Not excited: op does not move.");
  records.op.assign(records.op.size(), NAN);
  EXPECT_FALSE(judge(records).sufficient);
  EXPECT_FALSE(judge_excitation({}).sufficient);
}

TEST(Excitation, OpThatSticksForMostOfTheRecordIsNot) {
  Records records = known::run(known::scenario("healthy_flow").settings, 1);
  for (std::size_t k = 500; k < records.op.size(); ++k) records.op[k] = records.op[499];
  EXPECT_FALSE(judge(records).sufficient);
  EXPECT_EQ(judge(records).statement,
            "Not excited: op stands still for 88 % of the record at a stretch.");
}

TEST(Excitation, CoarseGridIsNot) {
  Records records = known::run(known::scenario("healthy_flow").settings, 1);
  for (double& op : records.op) op = 2.0 * std::round(op / 2.0);
  EXPECT_FALSE(judge(records).sufficient);
  EXPECT_EQ(judge(records).statement, "Not excited: op spans only 2 times its smallest step.");
}

TEST(Excitation, OpThatHardlyTurnsIsNot) {
  Records records;
  for (int k = 0; k < 4096; ++k) records.op.push_back(40.0 + 0.01 * std::abs(k - 2048));
  records.pv = records.op;
  EXPECT_EQ(judge(records).statement, "Not excited: op turns only 1 time.");
}

TEST(Excitation, IndependentSignalsAreNot) {
  int excited = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Records records;
    records.op = wandering(seed, 0.99, 0.03, 50.0);
    records.pv = wandering(seed + 1000, 0.95, 1.0);
    excited += judge(records).sufficient;
  }
  EXPECT_LE(excited, 2);
  Records unrelated;
  unrelated.op = wandering(1, 0.99, 0.03, 50.0);
  unrelated.pv = wandering(1001, 0.95, 1.0);
  EXPECT_EQ(judge(unrelated).statement,
            "Not excited: pv moves on its own: op shares 9 % of its moves.");
}

TEST(Excitation, LessThanAValveResolvesIsNot) {
  Records records = known::run(known::scenario("healthy_flow").settings, 1);
  for (double& op : records.op) op = 50.0 + 0.01 * (op - 50.0);
  EXPECT_FALSE(judge(records).sufficient);
  EXPECT_EQ(judge(records).statement,
            "Not excited: op spans 0.0484 %, less than a valve resolves (0.1 %).");
  // Without a range nothing is known of percent: the shape decides.
  EXPECT_TRUE(judge(records, false).sufficient);
  EXPECT_EQ(
      judge(records, false).statement,
      "op spans 0.0484 op units (range unknown), turns 198 times and shares 91 % of pv's moves.");
}

TEST(Excitation, ResponseUnderTheNoiseIsNot) {
  const Records records = known::run(known::scenario("healthy_flow").settings, 1);
  Series response = records.op;
  for (double& value : response) value = 0.01 * (value - 50.0);
  const Excitation weak = judge_excitation({records.op, records.pv, true, response});
  EXPECT_FALSE(weak.sufficient);
  EXPECT_EQ(weak.statement,
            "Not excited: the part of pv that follows op is only 0.0408 times its noise.");
  for (double& value : response) value *= 100.0;
  EXPECT_TRUE(judge_excitation({records.op, records.pv, true, response}).sufficient);
}

TEST(Excitation, LengthsHaveToAgree) {
  const Series one(10), other(11);
  EXPECT_THROW((void)judge_excitation({one, other, true, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
