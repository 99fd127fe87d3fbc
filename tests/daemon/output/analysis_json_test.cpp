#include "daemon/output/analysis_json.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using Json = nlohmann::ordered_json;

/// Every key that contract.md promises, as JSON pointers.
constexpr const char* kPromised[] = {"/input/file",
                                     "/input/samples",
                                     "/input/interval_s",
                                     "/input/start",
                                     "/input/end",
                                     "/data_quality/usable",
                                     "/data_quality/flags",
                                     "/data_quality/repeated_times",
                                     "/data_quality/missing_fraction",
                                     "/data_quality/compression_factor",
                                     "/data_quality/quantisation_factor",
                                     "/data_quality/saturated_fraction",
                                     "/hos/segments",
                                     "/hos/bifrequencies",
                                     "/hos/mean_bic2",
                                     "/hos/std_bic2",
                                     "/hos/max_bic2",
                                     "/hos/ngi",
                                     "/hos/nli",
                                     "/hos/published/gaussian",
                                     "/hos/published/linear",
                                     "/hos/ngi_p",
                                     "/hos/nli_p",
                                     "/hos/cubic_p",
                                     "/hos/nonlinear_p",
                                     "/hos/coupling",
                                     "/hos/peaks",
                                     "/hos_slow",
                                     "/oscillation/present",
                                     "/oscillation/period_s",
                                     "/oscillation/regularity",
                                     "/oscillation/amplitude",
                                     "/performance/harris_low",
                                     "/performance/harris_high",
                                     "/performance/error_std",
                                     "/performance/valve_travel_per_h",
                                     "/performance/reversals_per_h",
                                     "/performance/auto_fraction",
                                     "/performance/at_limit_fraction",
                                     "/shape/horch_dtau",
                                     "/shape/horch_drho",
                                     "/shape/shape_index",
                                     "/shape/ellipse_stiction",
                                     "/model/excited",
                                     "/model/excitation",
                                     "/model/error_kind",
                                     "/model/noise_floor",
                                     "/model/baseline/description",
                                     "/model/baseline/holdout_error",
                                     "/model/steps",
                                     "/model/unexplained/fraction",
                                     "/model/unexplained/whiteness_p",
                                     "/model/unexplained/ngi_p",
                                     "/model/unexplained/statement",
                                     "/model/questions",
                                     "/model/closed_loop",
                                     "/verdict/code",
                                     "/verdict/confidence",
                                     "/verdict/p",
                                     "/verdict/summary",
                                     "/verdict/reasons",
                                     "/verdict/action"};

core::signal::LoopWindow noisy_sine(std::size_t size) {
  core::signal::LoopWindow window;
  for (std::size_t k = 0; k < size; ++k) {
    const auto t = static_cast<double>(k);
    window.pv.push_back(std::sin(0.3 * t) + 0.3 * std::sin(std::fmod(t * t, 17.0)));
  }
  window.sp.assign(size, 0.0);
  return window;
}

void expect_promised_keys(const Json& json) {
  for (const char* pointer : kPromised) {
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
  }
}

TEST(AnalysisJson, HasEveryPromisedKeyWhenJudged) {
  const auto json =
      analysis_json({"f.csv", 1000, 1.0, 0.0, 999.0}, core::diagnose(noisy_sine(1000), {}));
  expect_promised_keys(json);
  EXPECT_TRUE(json["hos"]["ngi"].is_number());
  EXPECT_TRUE(json["hos_slow"].is_null());
  EXPECT_EQ(json["verdict"]["reasons"].type(), Json::value_t::array);
}

TEST(AnalysisJson, HasEveryPromisedKeyWhenNotJudged) {
  const auto json = analysis_json({"f.csv", 10, 1.0, 0.0, 9.0}, core::diagnose(noisy_sine(10), {}));
  expect_promised_keys(json);
  EXPECT_TRUE(json["hos"]["ngi"].is_null());
  EXPECT_EQ(json["verdict"]["code"], "insufficient_data");
}

TEST(AnalysisJson, TheSlowLookHasTheSameKeysAndItsOwn) {
  core::signal::LoopWindow window = noisy_sine(4096);
  for (std::size_t k = 0; k < window.size(); ++k) {
    window.pv[k] += 5.0 * std::sin(static_cast<double>(k) / 30.0);
  }
  const auto json = analysis_json({"f.csv", 4096, 1.0, 0.0, 4095.0}, core::diagnose(window, {}));
  Json slow = json["hos_slow"];
  EXPECT_EQ(slow["decimation"], 16);
  EXPECT_EQ(slow["samples"], 4096);
  slow.erase("decimation");
  slow.erase("samples");
  ASSERT_EQ(slow.size(), json["hos"].size());
  for (const auto& [key, value] : json["hos"].items()) EXPECT_TRUE(slow.contains(key)) << key;
}

TEST(AnalysisJson, TheModelOfTheEvidenceIsShown) {
  core::Diagnosis diagnosis = core::diagnose(noisy_sine(1000), {});
  diagnosis.evidence.model.emplace().steps.resize(2);
  const auto json = analysis_json({"f.csv", 1000, 1.0, 0.0, 999.0}, diagnosis);
  expect_promised_keys(json);
  EXPECT_EQ(json["model"]["steps"].size(), 2U);
}

TEST(AnalysisJson, RepeatedTimesAreCounted) {
  core::signal::LoopWindow window = noisy_sine(1000);
  window.repeated_times = 3;
  const auto json = analysis_json({"f.csv", 1000, 1.0, 0.0, 999.0}, core::diagnose(window, {}));
  EXPECT_EQ(json["data_quality"]["repeated_times"], 3);
}

TEST(AnalysisJson, AFileNameThatIsNoUtf8StillGivesJson) {
  const Json json = Json::parse(json_text({{"file", "bad\xff.csv"}}));
  EXPECT_EQ(json["file"], "bad\xEF\xBF\xBD.csv");
}

}  // namespace
}  // namespace loopscope::daemon
