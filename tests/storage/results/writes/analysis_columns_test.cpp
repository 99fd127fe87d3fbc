#include "storage/results/writes/analysis_columns.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class AnalysisColumnsTest : public ResultsTest {
 protected:
  void SetUp() override {
    ResultsTest::SetUp();
    if (IsSkipped()) return;
    add_loops({"a"});
    ResultsDatabase results = connect();
    loop = completed(claim_all(results).at(0), slot(1), "d1");
  }
  /// Stores the loop and returns a column of its analysis.
  [[nodiscard]] std::string stored(const std::string& column) const {
    return value("SELECT " + column + " FROM loopscope.analysis");
  }
  CompletedLoop loop;
};

/// Gives every figure a value of its own.
class Numberer {
 public:
  template <typename Field>
  void operator()(const std::string& column, Field& field) {
    values[column] = ++last_;
    field = static_cast<typename Value<Field>::type>(last_);
  }
  std::map<std::string, int> values;

 private:
  template <typename Field>
  struct Value {
    using type = Field;
  };
  template <typename Inner>
  struct Value<std::optional<Inner>> {
    using type = Inner;
  };
  int last_ = 0;
};

void number_hos(core::hos::Result& hos, Numberer& number) {
  number("segments", hos.segments);
  number("bifrequencies", hos.bifrequencies);
  number("mean_bic2", hos.mean_bic2);
  number("std_bic2", hos.std_bic2);
  number("max_bic2", hos.max_bic2);
  number("critical_mean_bic2", hos.critical_mean_bic2);
  number("ngi", hos.ngi);
  number("nli", hos.nli);
  number("skewness", hos.skewness);
  number("excess_kurtosis", hos.excess_kurtosis);
  number("ngi_p", hos.ngi_p);
  number("nli_p", hos.nli_p);
  number("cubic_p", hos.cubic_p);
  number("nonlinear_p", hos.nonlinear_p);
}

void number_time_domain(core::Evidence& evidence, Numberer& number) {
  number("oscillation_period_s", evidence.oscillation.period_s);
  number("oscillation_regularity", evidence.oscillation.regularity);
  number("oscillation_amplitude", evidence.oscillation.amplitude);
  number("oscillation_persistence", evidence.oscillation.persistence);
  number("oscillation_p", evidence.oscillation.p);
  number("harris_low", evidence.performance.harris_low);
  number("harris_high", evidence.performance.harris_high);
  number("harris_p", evidence.performance.harris_p);
  number("error_std", evidence.performance.error_std);
  number("valve_travel_per_h", evidence.performance.valve_travel_per_h);
  number("reversals_per_h", evidence.performance.reversals_per_h);
  number("auto_fraction", evidence.performance.auto_fraction);
  number("at_limit_fraction", evidence.performance.at_limit_fraction);
  number("horch_dtau", evidence.shape.horch_dtau);
  number("horch_drho", evidence.shape.horch_drho);
  number("shape_index", evidence.shape.shape_index);
  number("ellipse_stiction", evidence.shape.ellipse_stiction);
  number("ellipse_r2", evidence.shape.ellipse_r2);
  number("mv_op_width", evidence.shape.mv_op_width);
  number("mv_slip_jump", evidence.shape.mv_slip_jump);
  number("mv_stuck_fraction", evidence.shape.mv_stuck_fraction);
}

void number_model(core::model::Explanation& model, Numberer& number) {
  number("model_noise_floor", model.noise_floor);
  number("model_baseline_error", model.baseline.holdout_error);
  number("model_unexplained_fraction", model.unexplained.fraction);
}

TEST_F(AnalysisColumnsTest, EveryFigureLandsInItsOwnColumn) {
  AnalysisRecord& record = *loop.record;
  core::Evidence& evidence = record.diagnosis.evidence;
  Numberer number;
  number("fetch_ms", record.fetch_ms);
  number("analyse_ms", record.analyse_ms);
  number("prepare_ms", record.prepare_ms);
  number("statistics_ms", record.statistics_ms);
  number("model_ms", record.model_ms);
  number("samples", record.samples);
  number("interval_s", record.sample_interval_s);
  number("missing_fraction", evidence.data_quality.missing_fraction);
  number("compression_factor", evidence.data_quality.compression_factor);
  number("quantisation_factor", evidence.data_quality.quantisation_factor);
  number("saturated_fraction", evidence.data_quality.saturated_fraction);
  number_hos(*evidence.hos, number);
  number_time_domain(evidence, number);
  number_model(evidence.model.emplace(), number);
  connect().finish(std::vector{loop}, {});
  for (const auto& [column, expected] : number.values) {
    EXPECT_EQ(stored(column), std::to_string(expected)) << column;
  }
}

TEST_F(AnalysisColumnsTest, WordsSwitchesAndTimesToo) {
  core::Evidence& evidence = loop.record->diagnosis.evidence;
  evidence.hos->published.gaussian = false;
  evidence.data_quality.reason = "pv is constant";
  evidence.data_quality.usable = false;
  connect().finish(std::vector{loop}, {});
  EXPECT_EQ(stored("window_start"), "2025-12-31 23:51:45+00");
  EXPECT_EQ(stored("window_end"), "2026-01-01 01:00:00+00");
  EXPECT_EQ(stored("settings"), R"({"hos": {"segment_length": 64}})");
  EXPECT_EQ(stored("program_version || ' ' || input_digest"), "0.1.0 d1");
  EXPECT_EQ(stored("flags[2]"), "a \"quoted\", odd {flag}\\");
  EXPECT_EQ(stored("cardinality(flags)"), "2");
  EXPECT_EQ(stored("usable"), "f");
  EXPECT_EQ(stored("unusable_reason"), "pv is constant");
  EXPECT_EQ(stored("published_gaussian"), "f");
  EXPECT_EQ(stored("published_linear"), "t");
  EXPECT_EQ(stored("coupling"), "quadratic");
  EXPECT_EQ(stored("oscillating"), "t");
}

TEST_F(AnalysisColumnsTest, TheSlowLookIsAnObjectOrNull) {
  loop.record->hos_slow_json = R"({"ngi": 0.30000000000000004, "decimation": 17})";
  connect().finish(std::vector{loop}, {});
  EXPECT_EQ(stored("hos_slow->>'decimation'"), "17");
  EXPECT_EQ(stored("(hos_slow->'ngi')::float8"), "0.30000000000000004");
  loop.record->hos_slow_json.clear();
  loop.record->input_digest = "d2";
  database->execute("UPDATE loopscope.schedule SET visible_at = now()");
  ResultsDatabase results = connect();
  loop.fence = claim_all(results).at(0).fence;
  results.finish(std::vector{loop}, {});
  EXPECT_EQ(stored("hos_slow"), "NULL");
}

TEST_F(AnalysisColumnsTest, TheModelIsAnObjectWithoutItsStepsOrNull) {
  explain(*loop.record);
  loop.record->diagnosis.evidence.model->noise_floor = std::numeric_limits<double>::infinity();
  connect().finish(std::vector{loop}, {});
  EXPECT_EQ(stored("model_excited"), "t");
  EXPECT_EQ(stored("model_error_kind"), "simulation");
  EXPECT_EQ(stored("model_noise_floor"), "NULL") << "no finite number";
  EXPECT_EQ(stored("model->'baseline'->>'description'"), "first order");
  EXPECT_EQ(stored("model ? 'closed_loop' AND NOT model ? 'steps'"), "t");
}

TEST_F(AnalysisColumnsTest, WithoutAModelItsColumnsAreNull) {
  connect().finish(std::vector{loop}, {});
  EXPECT_EQ(stored("num_nonnulls(model_excited, model_error_kind, model_noise_floor,"
                   " model_baseline_error, model_unexplained_fraction, model)"),
            "0");
}

TEST_F(AnalysisColumnsTest, DoublesSurviveToTheLastDigit) {
  loop.record->diagnosis.evidence.hos->ngi = 0.1 + 0.2;
  connect().finish(std::vector{loop}, {});
  EXPECT_EQ(stored("ngi"), "0.30000000000000004");
}

}  // namespace
}  // namespace loopscope::storage
