#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/residual_tests/tests/coupling.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

std::string statement_in(const std::vector<TestOutcome>& answers, std::string_view question) {
  const TestOutcome* answer = tests::answer_of(answers, question);
  return answer == nullptr ? "not asked" : answer->question.statement;
}

tests::Questionable residual_of(const char* scenario) {
  return tests::arx_residual(simulate::simulate_scenario(scenario, {}, 1));
}

TEST(ResidualStatements, EveryQuestionSaysWhatItFoundInASentence) {
  struct Case {
    const char* scenario;
    const char* question;
    const char* statement;
  };
  for (const Case& one :
       {Case{"load_upsets", "white",
             "The residual is autocorrelated, most at 1 s (1 sample) before, 9.96 standard errors, "
             "with the opposite sign."},
        Case{"holding_sensor", "white",
             "The residual is autocorrelated, most at 10 s (10 samples) before, 10.9 standard "
             "errors, with the same sign."},
        Case{"paper_5_3", "op_dynamics",
             "The residual follows moves of op, most those of 16 s (16 samples) before, 4.91 "
             "standard errors: the linear model's dead time or order does not fit."},
        Case{"deadband", "op_direction",
             "The residual depends on the direction of the last move of op, beyond op itself (1024 "
             "reversals), most as with 3.73 % of dead band: hysteresis between op and pv."},
        Case{"saturated_valve", "op_level",
             "Moves of op above 49.3 % (35 % of the samples) have another effect on pv than the "
             "others."},
        Case{"deadband", "op_level",
             "Moves of op below 48 % (8 % of the samples) have another effect on pv than the "
             "others."},
        Case{"worn_valve", "op_level",
             "Moves of op have more effect at one end of its range than at the other: the residual "
             "follows the square of op."},
        Case{"nonlinear_process", "response_level",
             "The process gain depends on the operating point: the residual follows the square of "
             "the model's response, whose standard deviation is 10.5 units of pv."},
        Case{"process_gain_change", "time_gain",
             "The process responds about 2.41 times as strongly from 35.4 min into the window "
             "(sample 2121) on."},
        Case{"quantised_sensor", "time_spread",
             "The residual is 1.72 times as large from 107 s into the window (sample 107) on."},
        Case{"load_upsets", "time_event",
             "Sudden disturbances beyond the noise: -19.8 units of pv 30.7 min into the window "
             "(sample 1844); 14.7 units of pv 47.8 min into the window (sample 2868); 11.8 units "
             "of pv "
             "13.7 min into the window (sample 820)."},
        Case{"outside_oscillation", "periodic",
             "A line in the spectrum: period 60 s (60 samples), amplitude 1.67 units of pv in pv."},
        Case{"process_gain_change", "periodic",
             "Lines in the spectrum: period 3.99 min (240 samples), amplitude 0.928 units of pv in "
             "pv; period 2.85 min (171 samples), amplitude 0.609 units of pv in pv; period 70.5 s "
             "(70.5 samples), amplitude 0.317 units of pv in pv."},
        Case{"quantised_sensor", "grid",
             "pv moves in steps of 1 unit of pv (5 values), 2.12 times its fast noise."},
        Case{"holding_sensor", "held", "pv is renewed only every 12 samples (12 s)."},
        Case{"healthy_flow", "held", ""}}) {
    EXPECT_EQ(statement_in(test_residual(residual_of(one.scenario).view()), one.question),
              one.statement)
        << one.scenario;
  }
}

TEST(ResidualStatements, ASensorThatFreezesOrSkipsIsToldWithItsSamples) {
  tests::Questionable loop = residual_of("healthy_flow");
  for (std::size_t k = 1000; k < 1200; ++k) loop.pv[k] = loop.pv[1000];
  EXPECT_EQ(statement_in(test_residual(loop.view()), "held"),
            "pv stands still while op moves, for 200 samples (3.33 min), 16.7 min into the window "
            "(sample 1000).");
  for (std::size_t k = 1; k < loop.pv.size(); ++k)
    if (k * 7919 % 11 < 6) loop.pv[k] = loop.pv[k - 1];
  EXPECT_EQ(statement_in(test_residual(loop.view()), "held"),
            "pv is renewed only every 2.31 samples (2.31 s).");
  tests::Questionable coarse = residual_of("holding_sensor");
  for (double& pv : coarse.pv) pv = std::round(pv);
  EXPECT_EQ(statement_in(test_residual(coarse.view()), "held"),
            "pv is renewed by a clock, every 12 samples (12 s).");
}

TEST(ResidualStatements, OneSuddenDisturbanceIsNoPlural) {
  tests::Series innovation = tests::white(tests::White::gaussian, 4096, 5);
  innovation[2000] += 12.0;
  EXPECT_EQ(
      statement_in(test_residual(tests::closed_loop(innovation, 5).view()), "time_event"),
      "A sudden disturbance beyond the noise: 13.9 units of pv 33.3 min into the window (sample "
      "2000).");
}

TEST(ResidualStatements, CouplingIsNamedInWords) {
  const std::string start = "The residual shows phase coupling of frequencies, ";
  const auto coupled = [](const char* scenario) {
    return statement_in(test_coupling(residual_of(scenario).innovation, 3), "nonlinear");
  };
  EXPECT_EQ(coupled("paper_5_4_kano"), start + "cubic.");
  EXPECT_EQ(coupled("nonlinear_process"), start + "quadratic.");
  EXPECT_EQ(statement_in(test_coupling(residual_of("load_upsets").innovation, 3), "ngi"),
            "The residual is not Gaussian: its mean squared bicoherence is 0.031.");
}

}  // namespace
}  // namespace loopscope::core::model
