#include "core/diagnosis/evidence/nonlinearity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::diagnosis {
namespace {

using testing::HasSubstr;
using testing::Not;

Evidence with_p(double p, hos::Coupling coupling = hos::Coupling::none_found) {
  Evidence evidence;
  evidence.hos = hos::Result{};
  evidence.hos->segments = 127;
  evidence.hos->nonlinear_p = p;
  evidence.hos->coupling = coupling;
  return evidence;
}

TEST(Nonlinearity, IsFoundAtTheLevelOfTheSettings) {
  EXPECT_TRUE(judge_nonlinearity(with_p(0.05), {}).found);
  EXPECT_FALSE(judge_nonlinearity(with_p(0.051), {}).found);
  hos::Settings strict;
  strict.alpha = 0.001;
  EXPECT_FALSE(judge_nonlinearity(with_p(0.01), strict).found);
}

TEST(Nonlinearity, SaysWhatTheTestsRestOn) {
  Evidence evidence = with_p(1e-9);
  EXPECT_THAT(judge_nonlinearity(evidence, {}).reason, Not(HasSubstr("setpoint")));
  evidence.tested_on = TestedOn::model_residual;
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            "No quadratic or cubic phase coupling found: p = 1e-09 (p by test: quadratic on "
            "average 1, at single bifrequencies 1); published indices NGI 0, NLI 0 on 127 "
            "segments. The setpoint moves too often for those samples to be excluded: the tests "
            "use the error less the loop's linear response to the setpoint.");
  EXPECT_EQ(name(TestedOn::model_residual), "model_residual");
}

TEST(Nonlinearity, NoiseIsSaidForItselfWhereNothingIsFound) {
  Evidence evidence = with_p(0.4);
  evidence.data_quality.flags = {"heavy_tails", "variance_changes"};
  evidence.hos->noise = hos::NoiseShape{.excess_kurtosis = 4.0,
                                        .tails_p = 1e-20,
                                        .variance_p = 1e-9,
                                        .loudest_first = 1200,
                                        .loudest_size = 300,
                                        .loudest_ratio = 5.0};
  const std::string tested =
      "No quadratic or cubic phase coupling found: p = 0.4 (p by test: quadratic on average 1, at "
      "single bifrequencies 1); published indices NGI 0, NLI 0 on 127 segments.";
  const std::string outliers =
      " The disturbance has outliers (kurtosis 7 instead of 3, p < 1e-12).";
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            tested +
                " The disturbance comes in bursts (p = 1e-09), longest or loudest from sample 1201 "
                "to 1500, 5 times as strong as usual." +
                outliers + " Neither counts as nonlinearity.");
  evidence.data_quality.flags = {"heavy_tails"};
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            tested + outliers + " This does not count as nonlinearity.");
  evidence.data_quality.flags = {"variance_changes"};
  evidence.hos->noise->loudest_size = 0;
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            tested +
                " The disturbance comes in bursts (p = 1e-09). This does not count as "
                "nonlinearity.");
  evidence.hos->nonlinear_p = 1e-6;
  EXPECT_THAT(judge_nonlinearity(evidence, {}).reason, Not(HasSubstr("bursts")));
}

TEST(Nonlinearity, TooShortSaysWhatWouldDo) {
  Evidence evidence = with_p(0.4, hos::Coupling::too_short);
  evidence.samples_wanted = 5400;
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            "No quadratic or cubic phase coupling found: p = 0.4 (p by test: quadratic on average "
            "1, at single bifrequencies 1); published indices NGI 0, NLI 0 on 127 segments. The "
            "record is too short for the tests to see whether the oscillation is nonlinear: 5400 "
            "samples would do.");
  EXPECT_EQ(name(hos::Coupling::too_short), "too_short");
}

TEST(Nonlinearity, TwoLooksCountAsTwo) {
  Evidence evidence = with_p(0.04);
  EXPECT_DOUBLE_EQ(nonlinear_p(evidence), 0.04);
  evidence.hos_slow = hos::SlowLook{};
  EXPECT_DOUBLE_EQ(nonlinear_p(evidence), 0.04) << "a look without a p-value does not count";
  evidence.hos_slow->result.nonlinear_p = 0.5;
  EXPECT_NEAR(nonlinear_p(evidence), 1.0 - 0.96 * 0.96, 1e-12);
  evidence.hos_slow->result.nonlinear_p = 1e-8;
  EXPECT_NEAR(nonlinear_p(evidence), 2e-8, 1e-12);
}

TEST(Nonlinearity, NoLookIsNoFinding) {
  EXPECT_EQ(nonlinear_p(Evidence{}), 1.0);
  Evidence evidence = with_p(0.5);
  evidence.hos->nonlinear_p.reset();
  EXPECT_FALSE(judge_nonlinearity(evidence, {}).found);
  const std::string refused = "The tests for nonlinearity were refused: ";
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason, refused + "they have no p-value.");
  evidence.data_quality.refusals = {"one thing", "another"};
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason, refused + "one thing; another.");
}

TEST(Nonlinearity, WordsNameTheCouplingAndNeverSayLinear) {
  using hos::Coupling;
  EXPECT_THAT(judge_nonlinearity(with_p(0.7), {}).reason,
              HasSubstr("No quadratic or cubic phase coupling found: p = 0.7"));
  EXPECT_THAT(judge_nonlinearity(with_p(1e-5, Coupling::cubic), {}).reason,
              HasSubstr("Cubic phase coupling"));
  EXPECT_THAT(judge_nonlinearity(with_p(1e-5, Coupling::both), {}).reason,
              HasSubstr("Quadratic and cubic phase coupling"));
  for (const Coupling coupling :
       {Coupling::none_found, Coupling::quadratic, Coupling::cubic, Coupling::both}) {
    EXPECT_THAT(judge_nonlinearity(with_p(0.5, coupling), {}).reason, Not(HasSubstr("linear")));
  }
}

/// The published indices are no p-values: each has its name, and the tests have theirs.
TEST(Nonlinearity, TestsAndPublishedIndicesAreToldApart) {
  Evidence evidence = with_p(0.0, hos::Coupling::quadratic);
  evidence.hos->ngi = 0.021;
  evidence.hos->nli = 0.3;
  evidence.hos->ngi_p = 1e-308;
  evidence.hos->nli_p = 0.004;
  evidence.hos->cubic_p = 0.5;
  evidence.hos->innovation_p = 0.7;
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            "Quadratic phase coupling: p < 1e-12 (p by test: quadratic on average < 1e-12, at "
            "single bifrequencies 0.004, cubic 0.5, innovations 0.7); published indices NGI 0.021, "
            "NLI 0.3 on 127 segments.");
}

TEST(Nonlinearity, APeakIsNamedOnlyWhereItIsSignificant) {
  Evidence evidence = with_p(1e-6, hos::Coupling::quadratic);
  evidence.hos->peaks = {{0.05, 0.02, 0.9, {}}, {0.30, 0.12, 0.5, 1e-5}};
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            "Quadratic phase coupling: p = 1e-06 (p by test: quadratic on average 1, at single "
            "bifrequencies 1), strongest at the bifrequency (0.3, 0.12) cycles per sample; "
            "published indices NGI 0, NLI 0 on 127 segments.");
  evidence.hos->peaks[1].p = 0.2;
  EXPECT_THAT(judge_nonlinearity(evidence, {}).reason, Not(HasSubstr("bifrequency")));
}

TEST(Nonlinearity, TheSecondLookSaysHowItWasTaken) {
  Evidence evidence = with_p(0.7);
  evidence.hos_slow = hos::SlowLook{17, 8976, {}};
  evidence.hos_slow->result.nonlinear_p = 0.001;
  evidence.hos_slow->result.coupling = hos::Coupling::cubic;
  EXPECT_EQ(judge_nonlinearity(evidence, {}).reason,
            "No quadratic or cubic phase coupling found: p = 0.7 (p by test: quadratic on average "
            "1, at single bifrequencies 1); published indices NGI 0, NLI 0 on 127 segments. On "
            "data decimated by 17 (slow oscillation): cubic phase coupling (third harmonic, as of "
            "a square or triangular wave), p = 0.001 (p by test: quadratic on average 1, at single "
            "bifrequencies 1).");
}

/// The bounds are 2 and 7 %: 2000 records give 5 % to within 1 % (two errors).
TEST(Nonlinearity, NoiseIsFoundNonlinearAtTheNominalRate) {
  constexpr int kRecords = 2000;
  const auto records = static_cast<int>(loopscope::tests::records(kRecords));
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (const double pole : {0.0, 0.9, 1.0}) {
    int found = 0;
    for (int record = 0; record < records; ++record) {
      std::vector<double> signal(4096);
      double state = 0.0;
      for (double& value : signal) value = state = pole * state + normal(random);
      Evidence evidence;
      evidence.hos = hos::analyse(signal, {});
      found += judge_nonlinearity(evidence, {}).found ? 1 : 0;
    }
    EXPECT_LE(found, loopscope::tests::at_most(0.07 * kRecords, kRecords, records))
        << "pole " << pole;
    EXPECT_GE(found, loopscope::tests::at_least(0.02 * kRecords, kRecords, records))
        << "pole " << pole;
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
