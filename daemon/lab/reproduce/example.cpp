#include "daemon/lab/reproduce/example.hpp"

namespace loopscope::daemon {

namespace {

Example signal_example(const char* section, const char* title, const char* scenario,
                       PaperDecision decision) {
  Example example;
  example.section = section;
  example.title = title;
  example.scenario = scenario;
  example.decision = decision;
  // Enough to hold every peak that stands out; the paper names up to four.
  example.settings.max_peaks = 20;
  return example;
}

Example loop_example(const char* section, const char* title, const char* scenario,
                     PaperDecision decision, double ngi) {
  Example example = signal_example(section, title, scenario, decision);
  example.is_loop = true;
  example.ngi.value = ngi;
  return example;
}

Example narrow_band_linear() {
  Example example = signal_example("4.1", "y_linear", "paper_4_1_linear", PaperDecision::gaussian);
  example.ngi = {
      -0.0028,
      "without coupling the mean of bic2 is 1/K, which makes NGI -0.0004 give or take 0.001; "
      "-0.0028 asks for a third less coherence than chance leaves in K = 127 segments"};
  return example;
}

constexpr const char* kWindowDecides =
    "the window decides: compare the reading without one, which comes closer";

Example narrow_band_squared(core::hos::WindowShape window) {
  const bool tapered = window == core::hos::WindowShape::hann;
  Example example =
      signal_example("4.1", tapered ? "y_nonlinear" : "y_nonlinear, segments without window",
                     "paper_4_1_nonlinear", PaperDecision::nonlinear);
  example.settings.window = window;
  example.ngi = {0.002, tapered ? kWindowDecides
                                : "a rare record's figure: most give more than twice as much"};
  example.nli = {0.37, kWindowDecides};
  example.peaks = {{0.1, 0.1}};
  return example;
}

Example two_sinusoids_linear() {
  Example example =
      signal_example("4.2", "x (two sinusoids)", "paper_4_2_linear", PaperDecision::gaussian);
  example.ngi = {
      0.0008, "a chance figure of one record: without coupling NGI is -0.0004 give or take 0.001"};
  return example;
}

Example two_sinusoids_squared() {
  Example example = signal_example("4.2", "y (5 % of the square)", "paper_4_2_nonlinear",
                                   PaperDecision::nonlinear);
  example.ngi = {0.016, ""};
  example.nli = {0.233, "one record's figure, near the low end of the spread"};
  example.peaks = {{0.12, 0.12}, {0.18, 0.12}, {0.30, 0.30}, {0.30, 0.12}};
  example.remark =
      "(0.30, 0.30) has f1 + f2 = 0.6 > 0.5: it lies outside the L = 1024 bifrequencies that NGI "
      "and NLI average, and couples to 0.4 by aliasing; its share is that of seeds where bic2 "
      "there passes the level that chance passes in one of twenty.";
  return example;
}

std::vector<Example> loop_examples() {
  const char* const chance = "a chance figure: under no coupling NGI is -0.0004 give or take 0.001";
  Example well_tuned =
      loop_example("5.1", "well tuned", "paper_5_1", PaperDecision::gaussian, -0.0008);
  Example printed = loop_example("5.2", "I = 0.15/2.5 as printed", "paper_5_2_printed",
                                 PaperDecision::gaussian, -0.0007);
  printed.remark =
      "Printed as excessive integral action, but 0.06 is less than the 0.15 of 5.1: the loop is "
      "slower and does not oscillate. We take it for a misprint.";
  Example excessive = loop_example("5.2", "I = 0.15*2.5 as described", "paper_5_2_excessive",
                                   PaperDecision::gaussian, -0.0007);
  excessive.remark =
      "This reading oscillates as the text says; NGI and NLI cannot tell the two "
      "apart, both being linear.";
  Example outside =
      loop_example("5.3", "outside sinusoid", "paper_5_3", PaperDecision::gaussian, -0.0003);
  outside.remark = "The loop attenuates the sinusoid of amplitude 2; it stays a linear record.";
  well_tuned.paper_cause = "none";
  printed.paper_cause = excessive.paper_cause = "poorly tuned controller";
  outside.paper_cause = "external oscillatory disturbance";
  for (Example* example : {&well_tuned, &printed, &excessive, &outside}) {
    example->ngi.obstacle = chance;
  }
  return {well_tuned, printed, excessive, outside};
}

Example sticking(const char* title, const char* scenario) {
  Example example = loop_example("5.4", title, scenario, PaperDecision::nonlinear, 0.05);
  example.paper_cause = "valve stiction";
  example.nli.value = 0.048;
  return example;
}

Example sticking_by_figure_6() {
  Example example = sticking("stiction S = 3, J = 1, figure 6", "paper_5_4");
  example.ngi.obstacle =
      "the wandering load decides how often the valve is held back, so that NGI differs by a "
      "factor of ten between seeds";
  example.nli.obstacle = "as NGI: the figure of one load, which others do not share";
  example.remark = "The paper gives the setpoint step that starts the cycle no size: 10 here.";
  return example;
}

Example sticking_by_kano() {
  Example example = sticking("stiction S = 3, J = 1, Kano's law", "paper_5_4_kano");
  example.ngi.obstacle =
      "another valve: its limit cycle is more regular and nearly odd-symmetric, which the "
      "bispectrum cannot see";
  example.nli.obstacle = example.ngi.obstacle;
  example.remark =
      "Not the paper's valve: set beside it because the two laws give different records from the "
      "same S and J.";
  return example;
}

}  // namespace

const std::vector<Example>& paper_examples() {
  static const std::vector<Example> examples = [] {
    std::vector<Example> list = {narrow_band_linear(),
                                 narrow_band_squared(core::hos::WindowShape::hann),
                                 narrow_band_squared(core::hos::WindowShape::rectangular),
                                 two_sinusoids_linear(), two_sinusoids_squared()};
    for (Example& example : loop_examples()) list.push_back(std::move(example));
    list.push_back(sticking_by_figure_6());
    list.push_back(sticking_by_kano());
    return list;
  }();
  return examples;
}

}  // namespace loopscope::daemon
