#include "daemon/lab/calibrate/calibration_text.hpp"

#include <fmt/format.h>

#include "core/text/counted.hpp"
#include "daemon/lab/calibrate/calibration.hpp"
#include "daemon/lab/calibrate/cost.hpp"

namespace loopscope::daemon {
namespace {

using core::simulate::FamilyKind;

constexpr int kNameWidth = 36;
constexpr int kCellWidth = 16;

/// "12.3 (8-18)", marked where a signal without anything to find is rejected more often
/// than the level says, by its limits.
std::string cell(const TestTally& tally, std::size_t level, FamilyKind kind) {
  if (tally.computed == 0) return "- ";
  const BinomialShare share = binomial_share(tally.rejected[level], tally.computed);
  const bool nothing_to_find =
      kind == FamilyKind::linear_gaussian || kind == FamilyKind::linear_disturbed;
  const bool too_often = nothing_to_find && share.low > kLevels[level];
  return fmt::format("{:.1f} ({:.0f}-{:.0f}){}", 100.0 * share.share, 100.0 * share.low,
                     100.0 * share.high, too_often ? "*" : " ");
}

std::string heading_line() {
  std::string line = fmt::format("{:<{}}", "family", kNameWidth);
  for (const RecordTest& test : record_tests()) {
    line += fmt::format("{:>{}}", test.heading, kCellWidth);
  }
  return line + '\n';
}

std::string family_line(const FamilyTally& tally, std::size_t level) {
  std::string line = fmt::format("{:<{}}", tally.family.name, kNameWidth);
  for (const TestTally& test : tally.tests) {
    line += fmt::format("{:>{}}", cell(test, level, tally.family.kind), kCellWidth);
  }
  return line + '\n';
}

std::string kind_line(FamilyKind kind) {
  switch (kind) {
    case FamilyKind::linear_gaussian:
      return "-- linear, Gaussian: every rejection is false\n";
    case FamilyKind::linear_non_gaussian:
      return "-- linear, not Gaussian: only a test of Gaussianity may reject\n";
    case FamilyKind::linear_disturbed:
      return "-- linear, Gaussian, not stationary: every rejection is false\n";
    case FamilyKind::nonlinear:
      break;
  }
  return "-- nonlinear: every test may reject\n";
}

std::string table(const Calibration& calibration, std::size_t level) {
  std::string text = fmt::format("Rejected at nominal {:.0f} %, in % of {} (95 % limits)\n",
                                 100.0 * kLevels[level],
                                 core::text::counted(calibration.records, "record", "records"));
  text += heading_line();
  const FamilyTally* before = nullptr;
  for (const FamilyTally& tally : calibration.families) {
    const bool new_kind = before == nullptr || before->family.kind != tally.family.kind;
    if (new_kind) text += kind_line(tally.family.kind);
    text += family_line(tally, level);
    before = &tally;
  }
  return text + '\n';
}

std::string legend() {
  std::string text =
      "* more often than the level says, by its limits; - not computed. Each test rejects when\n";
  for (const RecordTest& test : record_tests()) {
    text += fmt::format("  {:<14}{}\n", test.heading, test.rule);
  }
  return text + '\n';
}

std::string cost_line(const Calibration& calibration) {
  const Cost cost = healthy_cost(calibration.families, calibration.records);
  return fmt::format(
      "CPU time of a linear Gaussian record: squared bicoherence {:.0f} us, whole analysis {:.0f} "
      "us: {:.1f} "
      "times\n",
      cost.estimate_us, cost.analyse_us, cost.ratio());
}

std::string plant_line(const PlantSummary& plant) {
  const std::string what =
      fmt::format("{} of {}, {} faulty: ", core::text::counted(plant.plants, "plant", "plants"),
                  core::text::counted(plant.loops, "loop", "loops"), plant.faulty);
  if (plant.untested == plant.plants * plant.loops) return what + "- (no nonlinear_p)\n";
  return what + fmt::format(
                    "{:.1f} flags, {:.1f} +- {:.1f} % of them false, {:.1f} +- {:.1f} % of "
                    "the faulty found{}\n",
                    plant.flags.mean, 100.0 * plant.false_share.mean,
                    100.0 * plant.false_share.standard_error, 100.0 * plant.found_share.mean,
                    100.0 * plant.found_share.standard_error,
                    plant.untested > 0
                        ? ", " + core::text::counted(plant.untested, "loop", "loops") + " untested"
                        : "");
}

std::string plants_text(const Calibration& calibration) {
  if (calibration.plants.empty()) return {};
  std::string text =
      "\nFalse-discovery control at 5 % (Benjamini-Hochberg on nonlinear_p), means over plants +- "
      "standard error\n";
  for (const PlantSummary& plant : calibration.plants) text += plant_line(plant);
  return text;
}

}  // namespace

std::string calibration_text(const Calibration& calibration) {
  std::string text;
  for (std::size_t level = 0; level < kLevels.size(); ++level) text += table(calibration, level);
  return text + legend() + cost_line(calibration) + plants_text(calibration);
}

}  // namespace loopscope::daemon
