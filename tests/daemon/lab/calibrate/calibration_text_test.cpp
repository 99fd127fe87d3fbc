#include "daemon/lab/calibrate/calibration_text.hpp"

#include <gtest/gtest.h>
#include <string>

namespace loopscope::daemon {
namespace {

using core::simulate::FamilyKind;

FamilyTally family_of(FamilyKind kind, const char* name) {
  FamilyTally tally;
  tally.family.kind = kind;
  tally.family.name = name;
  tally.tests[0] = {100, {12, 0}};
  tally.estimate_s = 0.01;
  tally.analyse_s = 0.05;
  return tally;
}

std::string padded(std::string text, std::size_t width) {
  return std::string(width - text.size(), ' ') + text;
}

/// A row: the first test's cell, nothing of the others.
std::string row(const std::string& name, const std::string& first) {
  std::string line = name + std::string(36 - name.size(), ' ') + padded(first, 16);
  for (int test = 1; test < 9; ++test) line += padded("- ", 16);
  return line + "\n";
}

std::string table(const char* level, const std::string& first, const std::string& second) {
  std::string text = std::string("Rejected at nominal ") + level +
                     " %, in % of 100 records (95 % limits)\nfamily" + std::string(30, ' ');
  for (const char* heading : {"NGI > 0", "rule", "Hinich G", "Hinich L", "Fackrell", "ngi_p",
                              "nli_p", "cubic_p", "nonlinear_p"})
    text += padded(heading, 16);
  return text + "\n-- linear, Gaussian: every rejection is false\n" + row("white", first) +
         "-- nonlinear: every test may reject\n" + row("squared", second) + "\n";
}

const std::string kLegend =
    "* more often than the level says, by its limits; - not computed. Each test rejects when\n"
    "  NGI > 0       NGI with the critical value of alpha is above 0 (eq. 12)\n"
    "  rule          NGI with the critical value of alpha > 0.001, and NLI > 0.01\n"
    "  Hinich G      sum of 2 K bic2 above chi-square with 2P degrees\n"
    "  Hinich L      interquartile range of 2 K bic2 off that of its law\n"
    "  Fackrell      more bifrequencies significant at 5 % than chance leaves\n"
    "  ngi_p         calibrated test of Gaussianity\n"
    "  nli_p         calibrated test of linearity\n"
    "  cubic_p       calibrated test of cubic coupling\n"
    "  nonlinear_p   the calibrated tests combined: what decides\n\n";
const std::string kCost =
    "CPU time of a linear Gaussian record: squared bicoherence 100 us, whole analysis 500 us: 5.0 "
    "times\n";

TEST(CalibrationText, TablesLegendAndCost) {
  const Calibration calibration{100,
                                {family_of(FamilyKind::linear_gaussian, "white"),
                                 family_of(FamilyKind::nonlinear, "squared")},
                                {}};
  EXPECT_EQ(calibration_text(calibration), table("5", "12.0 (6-20)*", "12.0 (6-20) ") +
                                               table("1", "0.0 (0-4) ", "0.0 (0-4) ") + kLegend +
                                               kCost);
}

TEST(CalibrationText, PlantsSayHowManyFlagsAreFalse) {
  Calibration calibration{100, {family_of(FamilyKind::linear_gaussian, "white")}, {}};
  PlantSummary plant;
  plant.plants = 2;
  plant.loops = 1000;
  plant.faulty = 20;
  plant.flags = {18.5, 0.5};
  plant.false_share = {0.045, 0.012};
  plant.found_share = {0.88, 0.02};
  calibration.plants = {plant, plant, plant};
  calibration.plants[1].untested = 1;
  calibration.plants[2].untested = 2000;
  const std::string text = calibration_text(calibration);
  const std::string figures =
      "2 plants of 1000 loops, 20 faulty: 18.5 flags, 4.5 +- 1.2 % of them false, 88.0 +- 2.0 % of "
      "the faulty found";
  EXPECT_EQ(text.substr(text.find("\nFalse-discovery")),
            "\nFalse-discovery control at 5 % (Benjamini-Hochberg on nonlinear_p), means over "
            "plants +- standard error\n" +
                figures + "\n" + figures +
                ", 1 loop untested\n"
                "2 plants of 1000 loops, 20 faulty: - (no nonlinear_p)\n");
}

}  // namespace
}  // namespace loopscope::daemon
