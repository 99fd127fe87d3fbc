#include "daemon/service/batches/analyse_window.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

namespace loopscope::daemon {
namespace {

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
  const storage::AnalysisRecord record = analyse_window({}, input, {}, "{}");
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
  EXPECT_EQ(analyse_window({}, input, {}, "{}").hos_slow_json, "");
}

TEST(AnalyseWindow, TheModelIsStoredWhereThereIsOne) {
  const storage::AnalysisRecord record = analyse_window({}, input_of(0), {}, "{}");
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
  const storage::AnalysisRecord always = analyse_window({}, quiet, {}, "{}");
  const storage::AnalysisRecord spared =
      analyse_window({}, quiet, {}, "{}", {core::ModelTrigger{}});
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
  EXPECT_TRUE(analyse_window({}, waving, {}, "{}", {core::ModelTrigger{}}).model_ms.has_value());
}

TEST(AnalyseWindow, TheStagesAreTimed) {
  LoopInput input = noise_input();
  input.first_look_ms = 1.5;
  const storage::AnalysisRecord record = analyse_window({}, input, {}, "{}");
  EXPECT_EQ(record.prepare_ms, 1.5);
  EXPECT_GT(record.statistics_ms, 0.0);
  EXPECT_GT(*record.model_ms, 0.0);
  EXPECT_GE(record.analyse_ms, record.prepare_ms + record.statistics_ms + *record.model_ms);
}

/// What a first look throws, the analysis of that loop throws.
TEST(AnalyseWindow, AFirstLookThatFailedFailsTheAnalysis) {
  LoopInput input;
  input.at_slot.window = slow_window(1000);
  input.at_slot.window.sp.pop_back();
  EXPECT_THROW((void)analyse_window({}, input, {}, "{}"), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::daemon
