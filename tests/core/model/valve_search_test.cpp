#include "core/model/valve_search.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string_view>
#include <vector>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

/// Every fourth block of 64 samples is left unseen.
std::vector<std::uint8_t> fit_mask(std::size_t samples) {
  std::vector<std::uint8_t> fit(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    fit[k] = (k / 64) % 4 == 3 ? 0 : 1;
  }
  return fit;
}

ValveSearchResult search(const simulate::LoopRecord& r) {
  return search_valve({r.pv, r.op, fit_mask(r.pv.size())});
}

/// A candidate of that band, within 10 %: which one is right is decided on unseen blocks.
bool found(const ValveSearchResult& result, double band) {
  return std::ranges::any_of(result.candidates, [&](const ValveCandidate& candidate) {
    return std::abs(candidate.valve.stickband_percent / band - 1.0) < 0.1;
  });
}

int hits(std::string_view scenario, double band) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    count += found(search(tests::scenario_record(scenario, seed)), band) ? 1 : 0;
  }
  return count;
}

TEST(ValveSearch, FindsTheBandOfThePapersValves) {
  EXPECT_EQ(hits("paper_5_4", 3.0), 5);
  EXPECT_EQ(hits("paper_5_4_kano", 3.0), 5);
}

TEST(ValveSearch, FindsTheBandOfPlantValves) {
  EXPECT_EQ(hits("sticking_valve", 5.0), 5);
  EXPECT_EQ(hits("square_limit_cycle", 4.0), 5);
  EXPECT_EQ(hits("sticking_level", 4.0), 5);
}

TEST(ValveSearch, FindsThePlayOfALinkage) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ValveSearchResult result = search(tests::scenario_record("deadband", seed));
    ASSERT_TRUE(result.deadband.has_value());
    EXPECT_NEAR(result.deadband->valve.stickband_percent, 4.0, 0.6);
    EXPECT_EQ(result.deadband->valve.slip_jump_percent, 0.0);
  }
}

TEST(ValveSearch, ItsPositionsAreTheValves) {
  const simulate::LoopRecord r = tests::scenario_record("paper_5_4_kano", 3);
  const ValveSearchResult result = search(r);
  ASSERT_FALSE(result.candidates.empty());
  const ValveCandidate& best = result.candidates[0];
  std::vector<double> mv(r.op.size());
  run_valve(best.valve, best.restarts, r.op, mv);
  // The level of a valve is known only up to (S - J) / 2 of the law: compare moves.
  double squares = 0.0;
  double moves = 0.0;
  for (std::size_t k = 1; k < mv.size(); ++k) {
    const double truth = r.mv[k] - r.mv[k - 1];
    squares += std::pow(mv[k] - mv[k - 1] - truth, 2.0);
    moves += truth * truth;
  }
  EXPECT_LT(squares, 0.2 * moves);
}

TEST(ValveSearch, BearsGaps) {
  simulate::LoopRecord r = tests::scenario_record("sticking_valve", 2);
  for (std::size_t k = 0; k < r.pv.size(); ++k) {
    r.pv[k] = k % 97 == 5 || (k > 1500 && k < 1800) ? kNaN : r.pv[k];
    r.op[k] = k < 3 || k % 211 == 9 || (k > 2500 && k < 2700) ? kNaN : r.op[k];
  }
  EXPECT_TRUE(found(search(r), 5.0));
}

TEST(ValveSearch, IsTheSameTwice) {
  const simulate::LoopRecord r = tests::scenario_record("sticking_valve", 1);
  const ValveSearchResult a = search(r);
  const ValveSearchResult b = search(r);
  ASSERT_EQ(a.candidates.size(), b.candidates.size());
  for (std::size_t i = 0; i < a.candidates.size(); ++i) {
    EXPECT_EQ(a.candidates[i].evidence, b.candidates[i].evidence);
    EXPECT_EQ(a.candidates[i].valve.stickband_percent, b.candidates[i].valve.stickband_percent);
  }
}

TEST(ValveSearch, FindsNothingWhereNothingMoves) {
  const std::vector<double> op(1000, 50.0);
  std::vector<double> pv(1000);
  for (std::size_t k = 0; k < pv.size(); ++k) {
    pv[k] = std::sin(0.1 * static_cast<double>(k));
  }
  EXPECT_TRUE(search_valve({pv, op, fit_mask(1000)}).candidates.empty());
  const std::vector<double> none(1000, kNaN);
  EXPECT_TRUE(search_valve({none, none, fit_mask(1000)}).candidates.empty());
  EXPECT_TRUE(search_valve({{}, {}, {}}).candidates.empty());
}

TEST(ValveSearch, RefusesUnequalLengths) {
  const std::vector<double> pv(10), op(9);
  EXPECT_THROW((void)search_valve({pv, op, fit_mask(10)}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
