#include "core/model/valve_search/stiction_search.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;

using loopscope::tests::kWindow;

struct ValveRecord {
  LoopData data;
  Structure behind;  ///< the linear loop's process behind play of about the band
  Fit linear;
};

/// A wandering op behind that valve, one lag and a little noise.
ValveRecord recorded(const Valve& valve, std::uint64_t seed) {
  Series op = tests::stepping_op(kWindow, seed, 3.0);
  const Series wander = tests::coloured_noise({1, {0.95, 0, 0}, {}}, kWindow, seed + 100, 0.5);
  op = tests::sum(op, wander);
  Series mv(kWindow);
  run_valve(valve, op, mv);
  const Series pv = tests::process_record(tests::one_lag(0.8, 3), 1.5, mv,
                                          tests::white_noise(kWindow, seed + 200, 0.3));
  ValveRecord result{make_loop_data(pv, op, 1.0), {}, {}};
  result.linear = search_process(result.data, {});
  result.behind = result.linear.structure;
  const Valve play{ValveLaw::he, 1.1 * valve.stickband_percent, 0.0, 1.0};
  result.behind.effects = {std::make_shared<ValveEffect>(play)};
  return result;
}

double gain_of(const ValveRecord& record, const GridResult& find) {
  return static_cast<double>(record.data.rows.fit_count()) *
         std::log(record.linear.fit_error / find.fit_error);
}

/// Both laws, three records each; what the true valve gains is known to the same record.
TEST(StemSearch, FindsTheBandOfAStemBetweenTheSamples) {
  int found = 0;
  for (const ValveLaw law : {ValveLaw::he, ValveLaw::kano}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Valve truth{law, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}};
      const ValveRecord record = recorded(truth, seed);
      const GridResult find = find_stem(record.data, record.behind, 4.4, law);
      EXPECT_GT(gain_of(record, find), 100.0);
      found += std::abs(tests::valve_of(find).stickband_percent - 4.0) < 0.12 ? 1 : 0;
    }
  }
  EXPECT_GE(found, 5);
}

TEST(StemSearch, FindsTheSameTwice) {
  const ValveRecord record = recorded({ValveLaw::he, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}}, 4);
  const GridResult first = find_stem(record.data, record.behind, 4.4, ValveLaw::he);
  const GridResult second = find_stem(record.data, record.behind, 4.4, ValveLaw::he);
  EXPECT_EQ(first.fit_error, second.fit_error);
  EXPECT_EQ(tests::valve_of(first).stickband_percent, tests::valve_of(second).stickband_percent);
}

TEST(StemSearch, ARecordShorterThanTheFirstWindowIsSearched) {
  ValveRecord record = recorded({ValveLaw::he, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}}, 5);
  LoopData& data = record.data;
  data = make_loop_data(std::span(data.pv).first(450), std::span(data.op).first(450), 1.0);
  const GridResult find = find_stem(data, record.behind, 4.4, ValveLaw::he);
  EXPECT_TRUE(std::isfinite(find.fit_error));
}

TEST(StemSearch, AnotherAttemptHasOtherGuesses) {
  const ValveRecord record = recorded({ValveLaw::he, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}}, 4);
  const GridResult first = find_stem(record.data, record.behind, 4.4, ValveLaw::he);
  const GridResult second = find_stem(record.data, record.behind, 4.4, ValveLaw::he, 1);
  EXPECT_NE(first.fit_error, second.fit_error);
}

/// A valve that moves at the samples is followed by its own law, which no stem comes near.
TEST(StemSearch, IsGivenUpFarBehindARival) {
  const Valve truth{ValveLaw::choudhury, 4.0, 2.5, 1.0};
  const ValveRecord record = recorded(truth, 7);
  const Structure rival = with_last(record.behind, std::make_shared<ValveEffect>(truth));
  EXPECT_TRUE(
      std::isinf(find_stem(record.data, record.behind, 4.4, ValveLaw::he, 0, &rival).fit_error));
  EXPECT_TRUE(std::isfinite(
      find_stem(record.data, record.behind, 4.4, ValveLaw::he, 0, &record.behind).fit_error));
}

/// Of play the search need not go to the end; what it gives is as good as the play.
TEST(StemSearch, PlayIsFoundAsPlay) {
  const ValveRecord record = recorded({ValveLaw::he, 4.0, 0.0, 1.0, {0.2, 0.0, 0.0}}, 6);
  const Valve valve = tests::valve_of(find_stem(record.data, record.behind, 4.4, ValveLaw::he));
  EXPECT_LT(valve.slip_jump_percent, ValveEffect::kPlay * valve.stickband_percent);
  EXPECT_NEAR(valve.stickband_percent, 4.0, 0.2);
}

TEST(StemSearch, IsForAValveThatNoOtherEffectWithinTheLoopFollows) {
  const auto play = std::make_shared<ValveEffect>(Valve{ValveLaw::he, 4.0, 0.0, 1.0});
  Structure behind;
  behind.effects = {play};
  EXPECT_TRUE(can_seek_sticking(behind));
  behind.effects = {std::make_shared<LoadStep>(1000), play};
  EXPECT_TRUE(can_seek_sticking(behind));
  behind.effects = {std::make_shared<GainChange>(1000, 2000), play};
  EXPECT_FALSE(can_seek_sticking(behind));
}

}  // namespace
}  // namespace loopscope::core::model
