#include "daemon/service/batches/loop_task.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using core::diagnosis::VerdictCode;

storage::ClaimedLoop loop_number(std::int64_t number,
                                 std::optional<storage::LastVerdict> last_verdict = {}) {
  storage::ClaimedLoop claim;
  claim.loop.loop_id = number;
  claim.loop.period_s = 3600.0;
  claim.last_verdict = last_verdict;
  return claim;
}

config::Settings large_plant() {
  config::Settings settings;
  settings.schedule.model_all_up_to = 500;
  settings.schedule.model_every_slots = 10;
  settings.flags.false_discovery_rate = 0.05;
  settings.flags.min_confidence = 0.3;
  return settings;
}

/// Whether the loop gets a model whatever its statistics say.
bool always(const storage::ClaimedLoop& claim, std::int64_t slot, std::size_t loops = 501) {
  return !model_wish(large_plant(), loops, claim, slot * kHour_us).cause;
}

/// Share of a thousand slots.
double share_of_turns(const storage::ClaimedLoop& claim) {
  int turns = 0;
  for (std::int64_t slot = 0; slot < 1000; ++slot) turns += always(claim, slot) ? 1 : 0;
  return turns / 1000.0;
}

TEST(ModelTurns, EveryLoopOfASmallPlant) {
  for (std::int64_t number = 1; number <= 20; ++number) {
    EXPECT_TRUE(always(loop_number(number), 7, 500));
  }
}

TEST(ModelTurns, ATenthOfALargeOneInEverySlot) {
  for (std::int64_t slot = 490'000; slot < 490'005; ++slot) {
    int turns = 0;
    for (std::int64_t number = 1; number <= 10'000; ++number) {
      turns += always(loop_number(number), slot) ? 1 : 0;
    }
    EXPECT_NEAR(turns, 1000, 120) << "four standard deviations";
  }
}

/// Visits may come every hour, every day, or whenever there is time: 300 of them leave out one loop
/// in 5e13.
TEST(ModelTurns, EveryLoopHasItsTurnsWhateverTheRhythmOfVisits) {
  for (const std::int64_t step : {1, 8, 10, 24, 240}) {
    for (std::int64_t number = 1; number <= 50; ++number) {
      int turns = 0;
      for (int visit = 0; visit < 300; ++visit) {
        turns += always(loop_number(number), 490'000 + step * visit) ? 1 : 0;
      }
      EXPECT_NEAR(turns, 30, 26) << "loop " << number << ", every " << step << " slots";
    }
  }
}

/// What a model found is not dropped for want of one in the next slot.
TEST(ModelTurns, AlwaysWhereTheLastVerdictWouldBeFlagged) {
  using Last = storage::LastVerdict;
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::valve_stiction, 0.8, 1e-6})), 1.0);
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::valve_saturation, 0.5, {}})), 1.0);
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::nonlinear_unexplained, 0.5, 0.03})),
              0.1, 0.05)
      << "one loop in thirty has that by chance";
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::unexplained, 0.2, {}})), 0.1, 0.05)
      << "less sure than what is flagged";
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::healthy, 0.6, {}})), 0.1, 0.05);
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::insufficient_data, 1.0, {}})), 1.0)
      << "what was found before may still stand";
}

TEST(ModelTurns, TheCauseIsWhatWouldBeFlagged) {
  std::int64_t slot = 490'000;
  while (always(loop_number(3), slot)) ++slot;
  const auto cause = model_wish(large_plant(), 501, loop_number(3), slot * kHour_us).cause;
  ASSERT_TRUE(cause);
  EXPECT_DOUBLE_EQ(cause->largest_p, 0.005);
  EXPECT_DOUBLE_EQ(cause->least_confidence, 0.3);
}

TEST(ModelTurns, PeriodsOfPartsOfASecondHaveTurnsToo) {
  storage::ClaimedLoop claim = loop_number(1);
  claim.loop.period_s = 1.5;
  int turns = 0;
  for (std::int64_t slot = 0; slot < 1000; ++slot) {
    turns += model_wish(large_plant(), 501, claim, slot * 1'500'000).cause ? 0 : 1;
  }
  EXPECT_NEAR(turns, 100, 40);
}

/// A slow wave with a coupled second harmonic; sample `size - 1` is the same for every size.
core::signal::LoopWindow slow_window(std::size_t size) {
  core::signal::LoopWindow window;
  for (std::size_t k = 20'000 - size; k < 20'000; ++k) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(k) / 204.0;
    const double noise = std::sin(std::fmod(static_cast<double>(k * k), 19.0));
    window.pv.push_back(std::cos(phase) + 0.3 * std::cos(2.0 * phase) + 0.1 * noise);
  }
  window.sp.assign(size, 0.0);
  return window;
}

LoopInput input_of(std::size_t longer) {
  LoopInput input;
  input.at_slot.window = slow_window(4096);
  input.first = core::first_look(input.at_slot.window, {});
  if (longer > 0) input.long_window = slow_window(longer);
  return input;
}

storage::AnalysisRecord analyse(const LoopInput& input, const ModelPolicy& wish = {}) {
  StageDriver driver;
  return analyse_window({}, input, {}, "{}", driver, wish);
}

TEST(AnalyseWindow, TheDigestCoversTheLongerSpan) {
  const LoopInput alone = input_of(0);
  LoopInput with = input_of(8976);
  const std::string digest = digest_of({}, with, "{}");
  EXPECT_EQ(digest.size(), 16U);
  EXPECT_EQ(digest, digest_of({}, input_of(8976), "{}"));
  EXPECT_NE(digest, digest_of({}, alone, "{}"));
  EXPECT_NE(digest, digest_of({}, input_of(8000), "{}"));
  EXPECT_NE(digest, digest_of({}, with, R"({"other": 1})"));
  with.long_window->pv[17] += 1.0;
  EXPECT_NE(digest, digest_of({}, with, "{}"));
}

/// Older rows may arrive later: that a longer span was asked for has to show although the historian
/// had nothing to add.
TEST(AnalyseWindow, ALongerSpanWithoutMoreRowsHasItsOwnDigest) {
  EXPECT_NE(digest_of({}, input_of(0), "{}"), digest_of({}, input_of(4096), "{}"));
}

TEST(AnalyseWindow, TheRecordHoldsTheSlowLookAndTheWindow) {
  const LoopInput input = input_of(8976);
  const storage::AnalysisRecord record = analyse(input);
  EXPECT_EQ(record.samples, 4096U);
  EXPECT_EQ(record.input_digest, digest_of({}, input, "{}"));
  const auto slow = nlohmann::json::parse(record.hos_slow_json);
  EXPECT_EQ(slow["samples"], 8976);
  EXPECT_EQ(slow["decimation"], 17);
  EXPECT_EQ(slow["ngi"].get<double>(), record.diagnosis.evidence.hos_slow->result.ngi);
}

TEST(AnalyseWindow, WithoutASlowLookNothingIsStoredOfOne) {
  LoopInput input;
  input.at_slot.window.pv.assign(100, 1.0);
  input.first = core::first_look(input.at_slot.window, {});
  EXPECT_EQ(analyse(input).hos_slow_json, "");
}

TEST(AnalyseWindow, TheModelIsStoredWhereThereIsOne) {
  const storage::AnalysisRecord record = analyse(input_of(0));
  EXPECT_EQ(record.model_json.empty(), !record.diagnosis.evidence.model.has_value());
}

/// A slow wave gives cause; white noise does not.
LoopInput noise_input() {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  LoopInput input;
  core::signal::LoopWindow& window = input.at_slot.window;
  for (int k = 0; k < 4096; ++k) {
    window.pv.push_back(50.0 + normal(random));
    window.op.push_back(50.0 + normal(random));
  }
  window.sp.assign(4096, 50.0);
  input.first = core::first_look(window, {});
  return input;
}

TEST(AnalyseWindow, AModelOnlyWhereThereIsCauseWhenThatIsTheWish) {
  const LoopInput quiet = noise_input();
  const storage::AnalysisRecord always = analyse(quiet);
  const storage::AnalysisRecord spared = analyse(quiet, {core::ModelTrigger{}});
  EXPECT_TRUE(always.model_ms.has_value());
  EXPECT_FALSE(spared.model_ms.has_value());
  EXPECT_TRUE(spared.model_json.empty());
  EXPECT_EQ(always.diagnosis.verdict.code, core::diagnosis::VerdictCode::healthy);
  EXPECT_EQ(spared.diagnosis.verdict.code, core::diagnosis::VerdictCode::healthy);
  EXPECT_EQ(always.input_digest, spared.input_digest);

  LoopInput waving = noise_input();
  for (std::size_t k = 0; k < 4096; ++k) {
    waving.at_slot.window.pv[k] += 8.0 * std::sin(0.1 * static_cast<double>(k));
  }
  waving.first = core::first_look(waving.at_slot.window, {});
  EXPECT_TRUE(analyse(waving, {core::ModelTrigger{}}).model_ms.has_value());
}

TEST(AnalyseWindow, TheStagesAreTimed) {
  LoopInput input = noise_input();
  input.prepare_ms = 1.5;
  StageDriver driver;
  const storage::AnalysisRecord record = analyse_window({}, input, {}, "{}", driver);
  EXPECT_EQ(record.prepare_ms, 1.5);
  EXPECT_GT(record.statistics_ms, 0.0);
  EXPECT_GT(*record.model_ms, 0.0);
  EXPECT_GE(record.analyse_ms, record.prepare_ms + record.statistics_ms + *record.model_ms);
  const storage::StageCost cost = driver.take();
  EXPECT_EQ(cost.analysed, 1U);
  EXPECT_EQ(cost.modelled, 1U);
  EXPECT_NEAR(1e3 * cost.statistics_s, record.statistics_ms, 1e-6);
  EXPECT_NEAR(1e3 * cost.model_s, *record.model_ms, 1e-6);
  EXPECT_GT(cost.decide_s, 0.0);
}

}  // namespace
}  // namespace loopscope::daemon
