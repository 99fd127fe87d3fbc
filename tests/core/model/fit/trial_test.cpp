#include "core/model/fit/trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/selection/candidate_fit.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/core/model/trial_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::absent_effects;
using tests::kNoise;
using tests::lagged_loop;
using tests::p_without;
using tests::share_below;
using tests::truth;

TEST(Trial, ComparedWithItselfNothingIsGained) {
  const LoopData data = lagged_loop(1);
  const CrossFit fit = cross_fit(data, evaluate(data, truth()));
  for (const bool once : {false, true}) {
    const Comparison same = compare(data, fit, fit, once);
    EXPECT_EQ(same.evidence, 0.0);
    EXPECT_EQ(same.p, 1.0);
    EXPECT_EQ(same.before, same.after);
    EXPECT_EQ(same.steadiness, 0.0);
  }
}

TEST(Trial, EvidenceIsTheLogarithmOfTheErrors) {
  const LoopData data = lagged_loop(2);
  const CrossFit before = cross_fit(data, evaluate(data, truth()));
  const CrossFit after =
      cross_fit(data, evaluate(data, tests::structure_of(tests::one_lag(0.1, 1))));
  const Comparison once = compare(data, before, after, true);
  EXPECT_NEAR(once.before, before.fit.score_error, 1e-12);
  EXPECT_NEAR(once.after, after.fit.score_error, 1e-12);
  const auto rows = static_cast<double>(data.rows.score_count());
  EXPECT_NEAR(once.evidence, rows * std::log(once.before / once.after), 1e-6);
  EXPECT_LT(once.evidence, 0.0);
  EXPECT_EQ(once.p, 1.0);
}

TEST(Trial, RowsThatBothHalvesSeeCountOnce) {
  const LoopData data = seen_whole(lagged_loop(2));
  LoopData shared = data;
  shared.rows.score = shared.rows.fit;
  const CrossFit before = cross_fit(shared, evaluate(shared, truth()));
  const CrossFit after =
      cross_fit(shared, evaluate(shared, tests::structure_of(tests::one_lag(0.1, 1))));
  EXPECT_EQ(compare(shared, before, after).evidence, compare(shared, before, after, true).evidence);
}

TEST(Trial, SwappingTurnsTheSign) {
  const LoopData data = lagged_loop(3);
  const CrossFit a = cross_fit(data, evaluate(data, truth()));
  const CrossFit b = cross_fit(data, evaluate(data, tests::structure_of(tests::one_lag(0.5, 3))));
  EXPECT_NEAR(compare(data, a, b).evidence, -compare(data, b, a).evidence, 1e-9);
}

TEST(Trial, ATwinSeesTheOtherRows) {
  const LoopData data = lagged_loop(4);
  const CrossFit fit = cross_fit(data, evaluate(data, truth()));
  const LoopData other = on_other_fold(data);
  EXPECT_LE(fit.other_fold.fit_error, evaluate(other, fit.fit.structure).fit_error * (1.0 + 1e-12));
  EXPECT_EQ(fit.other_fold.structure.process.delay_samples, 3U);
}

/// The bound of the split likelihood ratio holds at every level; two standard errors of room.
TEST(Trial, PIsAnUpperBoundWhereNothingIsThere) {
  for (const EffectPtr& effect : absent_effects()) {
    for (const bool once : {false, true}) {
      EXPECT_LE(share_below(p_without(effect, once, 100), 0.05), 0.05 + 0.044)
          << name(effect->kind()) << once;
    }
  }
}

TEST(Trial, AnEffectThatIsThereIsCertain) {
  const tests::Series op = tests::stepping_op(4096, 1);
  tests::Series noise = tests::coloured_noise(kNoise, 4096, 2, 0.5);
  for (std::size_t k = 0; k < 4096; ++k) noise[k] += 2.0 * std::sin(0.1 * static_cast<double>(k));
  const LoopData data =
      make_loop_data(tests::process_record(tests::one_lag(0.8, 3), 1.5, op, noise), op, 1.0);
  const CrossFit before = cross_fit(data, polish(data, truth()));
  const CrossFit after =
      cross_fit(data, evaluate(data, truth({std::make_shared<ExternalOscillation>(62.8)})));
  const Comparison found = compare(data, before, after);
  EXPECT_LT(found.p, 1e-6);
  EXPECT_EQ(found.steadiness, 1.0);
}

TEST(Trial, FitGainIsTheLogarithmOnTheRowsSeen) {
  const LoopData data = lagged_loop(5);
  const Fit a = evaluate(data, tests::structure_of(tests::one_lag(0.5, 3)));
  const Fit b = evaluate(data, truth());
  const auto rows = static_cast<double>(data.rows.fit_count());
  EXPECT_NEAR(fit_gain(data, a, b), rows * std::log(a.fit_error / b.fit_error), 1e-9);
}

TEST(Trial, RefiningAndFittingAnewAreNeverWorse) {
  const LoopData data = lagged_loop(6);
  for (const EffectPtr& effect : absent_effects()) {
    const Fit start = evaluate(data, truth({effect}));
    const Fit refined = refine_last(data, start);
    EXPECT_LE(refined.fit_error, start.fit_error) << name(effect->kind());
    EXPECT_LE(fit_candidate(data, start).fit_error, refined.fit_error * 1.01)
        << name(effect->kind());
  }
}

TEST(Trial, AGainTellsTheErrorThatIsLeft) {
  const LoopData data = lagged_loop(1);
  EXPECT_NEAR(gain_of(data, 2.0, error_after(data, 2.0, 7.5)), 7.5, 1e-9);
  EXPECT_EQ(error_after(data, 2.0, 0.0), 2.0);
}

}  // namespace
}  // namespace loopscope::core::model
