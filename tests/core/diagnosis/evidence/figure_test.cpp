#include "core/diagnosis/evidence/figure.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "core/diagnosis/odds/cause_curves.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

double value_of(std::string_view name, const Evidence& evidence) {
  return measure_figures(evidence)[figure_place(name).value()].value();
}

TEST(Figure, EveryNameStandsOnceAndHasWords) {
  std::set<std::string_view> names;
  for (const Figure& figure : all_figures()) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_FALSE(figure.words.empty()) << figure.name;
    EXPECT_EQ(figure_place(figure.name), static_cast<std::size_t>(&figure - all_figures().data()));
  }
  EXPECT_EQ(figure_place("no.such"), std::nullopt);
}

TEST(Figure, EveryOneHasASayInSomeCause) {
  std::set<std::string_view> used;
  for (const bool with_model : {true, false}) {
    for (const CauseCurves& cause : fitted_curves(with_model))
      for (const FigureCurve& curve : cause.curves) used.insert(curve.figure);
  }
  for (const Figure& figure : all_figures()) EXPECT_TRUE(used.contains(figure.name)) << figure.name;
}

TEST(Figure, NothingOfEmptyEvidenceIsANumberThatIsNone) {
  for (const auto& value : measure_figures(Evidence{}))
    EXPECT_TRUE(std::isfinite(value.value_or(0.0)));
}

TEST(Figure, StepsCountByTheirEvidence) {
  Evidence evidence = evidence_with(explanation_of(
      {clear_step(model::EffectKind::valve_stiction), clear_step(model::EffectKind::load_step)}));
  EXPECT_EQ(value_of("step.hysteresis", evidence), 500.0);
  EXPECT_EQ(value_of("step.load_step", evidence), 500.0);
  evidence.model->excited = false;
  EXPECT_EQ(measure_figures(evidence)[*figure_place("step.hysteresis")], std::nullopt)
      << "a model that is not excited claims nothing of the valve";
  EXPECT_EQ(value_of("step.load_step", evidence), 500.0) << "a load comes from outside";
}

TEST(Figure, ATransmittersRangeIsNeededForTheSizeOfAValve) {
  Evidence evidence = quiet_evidence();
  const auto size = [&] { return measure_figures(evidence)[*figure_place("size.gain")]; };
  EXPECT_EQ(size(), std::nullopt);
  evidence.valve_gain.pv_span_percent = 60.0;
  EXPECT_EQ(size(), std::nullopt);
  evidence.op_range_set = true;
  EXPECT_EQ(size(), 3.0);
}

TEST(Figure, TextsCarryTheirNumbers) {
  const auto text = [](std::string_view name, double value) {
    return figure_text(all_figures()[figure_place(name).value()], value);
  };
  EXPECT_EQ(text("oscillation.p", 3.0), "test whether an oscillation is present: p = 0.001");
  EXPECT_EQ(text("oscillation.p", 12.0), "test whether an oscillation is present: p < 1e-12");
  EXPECT_EQ(text("cycle.op_coherence", 0.934), "op repeats its half cycle: 93 %");
  EXPECT_EQ(text("data.held", 1.0), "pv is renewed less often than it is recorded: yes");
  EXPECT_EQ(text("data.held", 0.0), "pv is renewed less often than it is recorded: no");
  EXPECT_EQ(text("op.reversals", 0.0123), "reversals of op a sample: 0.0123");
}

TEST(Figure, DecadesOfP) {
  EXPECT_EQ(decades(1.0), 0.0);
  EXPECT_NEAR(decades(1e-3), 3.0, 1e-12);
  EXPECT_EQ(decades(0.0), kMostDecades);
  EXPECT_EQ(decades(2.0), 0.0);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
