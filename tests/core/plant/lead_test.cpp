#include "core/plant/lead.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "core/hos/numeric/normal_draw.hpp"
#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using loopscope::tests::kWindow;

/// Loop 0 drives loop 1 behind a lag, which drives loop 2; each has noise of its own.
struct Chain {
  std::vector<std::vector<double>> pv;
  std::vector<MemberLoop> loops;
  std::vector<std::size_t> members;

  explicit Chain(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const tests::Course course = tests::draw_course(kWindow, 40.0, 0.5, random);
    pv.push_back(tests::draw_error(course, 40.0, 0, 0.3, kWindow, random));
    for (int k = 0; k < 2; ++k) {
      std::vector<double> next(kWindow, 0.0);
      double level = 0.0;
      for (std::size_t j = 1; j < kWindow; ++j) {
        level += 0.1 * (pv.back()[j - 1] - level) + 0.02 * hos::normal_draw(random);
        next[j] = level;
      }
      pv.push_back(next);
    }
    for (std::size_t k = 0; k < pv.size(); ++k) {
      loops.push_back(tests::oscillating_loop(static_cast<std::int64_t>(k), pv[k]));
      loops.back().pv = pv[k];
      members.push_back(k);
    }
  }
};

TEST(Lead, WhatDrivesForetells) {
  int right = 0;
  constexpr int kChains = 20;
  for (std::uint64_t seed = 0; seed < kChains; ++seed) {
    const Chain chain(71 + seed);
    const std::vector<Lead> leads = find_leads(chain.loops, chain.members, 40.0);
    right +=
        net_lead(leads, 0) > net_lead(leads, 1) && net_lead(leads, 0) > net_lead(leads, 2) ? 1 : 0;
  }
  EXPECT_GE(right, 19);
}

TEST(Lead, LoopsThatKnowNothingOfEachOtherForetellNothing) {
  std::mt19937_64 random(72);
  std::vector<std::vector<double>> pv;
  std::vector<MemberLoop> loops;
  std::vector<std::size_t> members(5);
  std::iota(members.begin(), members.end(), std::size_t{0});
  for (std::size_t k = 0; k < members.size(); ++k) {
    const tests::Course course = tests::draw_course(kWindow, 40.0, 0.5, random);
    pv.push_back(tests::draw_error(course, 40.0, 0, 0.3, kWindow, random));
  }
  for (const auto& series : pv) loops.push_back(tests::oscillating_loop(1, series));
  double most = 0.0;
  for (const Lead& lead : find_leads(loops, members, 40.0)) most = std::max(most, lead.gain);
  EXPECT_LT(most, 0.05);
}

TEST(Lead, TheOrderOfMembersAndTheUnitsDoNotMatter) {
  Chain chain(73);
  const std::vector<Lead> leads = find_leads(chain.loops, chain.members, 40.0);
  for (double& value : chain.pv[1]) value = 1000.0 + 50.0 * value;
  const std::vector<std::size_t> turned{2, 1, 0};
  const std::vector<Lead> others = find_leads(chain.loops, turned, 40.0);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(net_lead(leads, k), net_lead(others, k), 0.02) << k;
}

TEST(Lead, AMemberThatIsHardlyRecordedTakesNoRowsOfTheOthers) {
  Chain chain(75);
  const std::vector<double> nothing(kWindow, std::numeric_limits<double>::quiet_NaN());
  for (MemberLoop& loop : chain.loops) loop.op = loop.pv;
  const std::size_t all = find_leads(chain.loops, chain.members, 40.0).size();
  chain.loops[2].op = nothing;  // a tag of bad quality throughout
  EXPECT_EQ(find_leads(chain.loops, chain.members, 40.0).size(), all);
  chain.loops[2].pv = chain.loops[2].error = nothing;
  for (const Lead& lead : find_leads(chain.loops, chain.members, 40.0))
    EXPECT_TRUE(lead.from != 2 && lead.to != 2);
  EXPECT_FALSE(find_leads(chain.loops, chain.members, 40.0).empty());
}

TEST(Lead, NeedsEnoughRowsInCommon) {
  Chain chain(74);
  EXPECT_TRUE(find_leads(chain.loops, chain.members, 4000.0).empty());
  EXPECT_TRUE(find_leads(chain.loops, {}, 40.0).empty());
  chain.loops[1].start_us += 1'000'000LL * 5000;
  EXPECT_TRUE(find_leads(chain.loops, chain.members, 40.0).empty());
  EXPECT_EQ(net_lead({}, 3), 0.0);
}

}  // namespace
}  // namespace loopscope::core::plant
