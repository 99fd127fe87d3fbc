#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/simulate/paper_signals.hpp"
#include "daemon/lab/reproduce/bifrequency.hpp"
#include "daemon/lab/reproduce/industrial_case.hpp"
#include "daemon/lab/reproduce/reproduction.hpp"
#include "daemon/lab/reproduce/reproduction_json.hpp"
#include "daemon/lab/reproduce/reproduction_text.hpp"

namespace loopscope::daemon {
namespace {

/// Few seeds keep the tests fast; what they check holds for nearly every seed.
const Reproduction& few_seeds() {
  static const Reproduction reproduction = reproduce_paper(10);
  return reproduction;
}

const MeasuredExample& example(std::string_view scenario) {
  for (const MeasuredExample& measured : few_seeds().examples) {
    if (measured.example.scenario == scenario) return measured;
  }
  throw std::invalid_argument("no such example");
}

TEST(Spread, InterpolatesBetweenOrderStatistics) {
  const Spread spread = spread_of({5.0, 1.0, 2.0, 4.0, 3.0});
  EXPECT_DOUBLE_EQ(spread.median, 3.0);
  EXPECT_DOUBLE_EQ(spread.p10, 1.4);
  EXPECT_DOUBLE_EQ(spread.p90, 4.6);
  EXPECT_EQ(spread.min, 1.0);
  EXPECT_EQ(spread.max, 5.0);
  EXPECT_EQ(spread_of({2.0}).p90, 2.0);
  EXPECT_THROW((void)spread_of({}), std::invalid_argument);
}

TEST(Agreement, ComparesAFigureWithTheSpread) {
  const Spread spread{0.5, 0.3, 0.7, 0.1, 0.9};
  EXPECT_EQ(agreement_of(0.3, spread), Agreement::met);
  EXPECT_EQ(agreement_of(0.8, spread), Agreement::in_range);
  EXPECT_EQ(agreement_of(1.0, spread), Agreement::not_met);
}

TEST(Bifrequency, IsTheEstimateOfTheTransformInsideThePrincipalDomain) {
  const std::vector<double> signal = core::simulate::two_sinusoids_squared(4096, 1);
  const core::hos::Settings settings;
  core::hos::Bicoherence bicoherence(settings);
  const auto bic2 = bicoherence.estimate(signal);
  const core::hos::PrincipalDomain& domain = bicoherence.domain();
  const std::size_t index = domain.index({.k1 = 38, .k2 = 15});
  const BifrequencyEstimate one = estimate_at(signal, 38.0 / 128.0, 15.0 / 128.0, settings);
  EXPECT_NEAR(one.bic2, bic2[index], 1e-9);
  EXPECT_EQ(one.segments, bicoherence.segments());
}

TEST(Reproduce, CouplingOfSection4IsFoundAndNothingElse) {
  for (const auto* scenario : {"paper_4_1_nonlinear", "paper_4_2_nonlinear"}) {
    EXPECT_EQ(example(scenario).measurement.decision_share, 1.0) << scenario;
    EXPECT_EQ(example(scenario).measurement.peak_seeds, 1.0) << scenario;
  }
  // The published rule calls about 6 % of linear records nonlinear: at most 4 of 10 by chance.
  for (const auto* scenario : {"paper_4_1_linear", "paper_4_2_linear", "paper_5_1",
                               "paper_5_2_printed", "paper_5_2_excessive", "paper_5_3"}) {
    EXPECT_GE(example(scenario).measurement.decision_share, 0.6) << scenario;
  }
}

TEST(Reproduce, FindsThePeaksOf42) {
  const auto& peaks = example("paper_4_2_nonlinear").measurement.peaks;
  ASSERT_EQ(peaks.size(), 4U);
  for (const PeakShare& peak : peaks) {
    EXPECT_GE(peak.share, 0.7) << peak.peak.f1 << ", " << peak.peak.f2;
    EXPECT_EQ(peak.in_principal_domain, peak.peak.f1 + peak.peak.f2 <= 0.5);
  }
}

TEST(Reproduce, TellsTheTwoReadingsOf52Apart) {
  const Spread& printed = example("paper_5_2_printed").measurement.error_std;
  const Spread& excessive = example("paper_5_2_excessive").measurement.error_std;
  EXPECT_GT(excessive.min, 2.0 * printed.max);
}

TEST(Reproduce, LoopsHaveAVerdictAndSignalsHaveNone) {
  for (const MeasuredExample& measured : few_seeds().examples) {
    EXPECT_EQ(measured.measurement.verdict.has_value(), measured.example.is_loop);
    EXPECT_EQ(measured.example.paper_cause.empty(), !measured.example.is_loop);
  }
}

TEST(Reproduce, TextOfOneExampleLineByLine) {
  MeasuredExample measured;
  measured.example.section = "5.4";
  measured.example.title = "a sticking valve";
  measured.example.decision = PaperDecision::nonlinear;
  measured.example.ngi = {0.02, ""};
  measured.example.nli = {0.9, "a misprint"};
  measured.example.paper_cause = "stiction";
  measured.example.remark = "two readings";
  Measurement& ours = measured.measurement;
  ours.ngi = {0.021, 0.015, 0.03, 0.01, 0.04};
  ours.nli = {0.31, 0.25, 0.4, 0.2, 0.5};
  ours.error_std = {1.5, 1.25, 1.75, 1.0, 2.0};
  ours.decision_share = 0.98;
  ours.peaks = {{{0.3, 0.12}, true, 0.9}, {{0.4, 0.3}, false, 0.1}};
  ours.peak_seeds = 1.0;
  ours.max_f1 = {0.297, 0.0, 0.0, 0.0, 0.0};
  ours.max_f2 = {0.117, 0.0, 0.0, 0.0, 0.0};
  ours.verdict = {"valve_stiction", 0.95};
  const std::string text = reproduction_text({10, {measured}});
  EXPECT_EQ(text.substr(0, text.find("Section 6")),
            "Examples of sections 4 and 5 over 10 seeds: the paper's figure, our median [10th .. "
            "90th\npercentile]. met: the paper's figure lies between those percentiles; within all "
            "seeds:\nbetween our smallest and largest.\n\n"
            "5.4 a sticking valve\n"
            "  NGI            0.0200     0.0210 [  0.0150 ..   0.0300]   met\n"
            "  NLI            0.9000     0.3100 [  0.2500 ..   0.4000]   NOT met\n"
            "              why: a misprint\n"
            "  decision    nonlinear   the published rule decides so in 98 % of the seeds\n"
            "  peak     (0.30, 0.12)   found in 90 % of the seeds\n"
            "  peak     (0.40, 0.30)   found in 10 % of the seeds (outside the principal domain)\n"
            "                          maximum at (0.297, 0.117), median over the seeds\n"
            "  error std           -     1.5000 [  1.2500 ..   1.7500]\n"
            "  our verdict             valve_stiction in 95 % of the seeds (the paper's cause: "
            "stiction)\n"
            "  note: two readings\n\n");
}

TEST(Reproduce, TextSaysWhyAFigureIsNotMet) {
  const std::string text = reproduction_text(few_seeds());
  for (const auto* part : {"4.1 y_linear", "5.2 I = 0.15/2.5 as printed",
                           "5.2 I = 0.15*2.5 as described", "why:", "6.2.2", "misprint"}) {
    EXPECT_THAT(text, testing::HasSubstr(part));
  }
}

TEST(Reproduce, JsonHoldsEveryExampleAndCase) {
  const auto json = reproduction_json(few_seeds());
  EXPECT_EQ(json.at("seeds"), 10);
  ASSERT_EQ(json.at("examples").size(), paper_examples().size());
  EXPECT_EQ(json.at("industrial_cases").size(), industrial_cases().size());
  const auto& first = json.at("examples").at(0);
  EXPECT_EQ(first.at("ngi").at("paper"), -0.0028);
  EXPECT_TRUE(first.at("ngi").at("median").is_number());
  EXPECT_TRUE(first.at("nli").at("paper").is_null());
  EXPECT_TRUE(first.at("verdict").is_null());
}

TEST(Reproduce, FiguresThatAreNotMetHaveAReason) {
  for (const Example& one : paper_examples()) {
    const bool always_met = one.scenario == "paper_4_2_nonlinear";
    EXPECT_TRUE(!one.ngi.value || always_met || !one.ngi.obstacle.empty()) << one.title;
    EXPECT_TRUE(!one.nli.value || !one.nli.obstacle.empty()) << one.title;
  }
}

}  // namespace
}  // namespace loopscope::daemon
