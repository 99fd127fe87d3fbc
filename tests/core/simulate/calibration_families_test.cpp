#include "core/simulate/calibration_families.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <set>

#include "core/simulate/paper_loops.hpp"
#include "tests/core/simulate/spectrum.hpp"

namespace loopscope::core::simulate {
namespace {

/// NaN equals NaN here.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

const CalibrationFamily& family(std::string_view wanted) {
  return *std::ranges::find(calibration_families(), wanted,
                            [](const auto& one) { return std::string_view(one.name); });
}

TEST(CalibrationFamilies, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const auto& one : calibration_families()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_FALSE(one.description.empty()) << one.name;
    EXPECT_EQ(one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_."),
              std::string::npos)
        << one.name;
  }
}

TEST(CalibrationFamilies, CoverEveryKind) {
  for (const auto& [kind, least] :
       {std::pair{FamilyKind::linear_gaussian, 20L}, std::pair{FamilyKind::linear_non_gaussian, 6L},
        std::pair{FamilyKind::linear_disturbed, 4L}, std::pair{FamilyKind::nonlinear, 20L}}) {
    const auto wanted = kind;
    EXPECT_GE(std::ranges::count_if(calibration_families(),
                                    [=](const auto& one) { return one.kind == wanted; }),
              least)
        << name(kind);
  }
}

TEST(CalibrationFamilies, ASeedIsARecord) {
  for (const auto& one : calibration_families()) {
    const auto record = one.draw(one.samples, 11);
    EXPECT_EQ(record.size(), one.samples) << one.name;
    EXPECT_TRUE(same_bits(record, one.draw(one.samples, 11))) << one.name;
    EXPECT_FALSE(same_bits(record, one.draw(one.samples, 12))) << one.name;
  }
}

TEST(CalibrationFamilies, OnlyMaskedOnesMissSamples) {
  for (const auto& one : calibration_families()) {
    const auto record = one.draw(one.samples, 5);
    const auto missing = std::ranges::count_if(record, [](double x) { return !std::isfinite(x); });
    const bool masked = one.name.ends_with("_gaps") || one.name.ends_with("_masked");
    EXPECT_EQ(missing > 0, masked) << one.name;
  }
}

TEST(CalibrationFamilies, LoopsAreThoseOfThePaper) {
  EXPECT_EQ(family("paper_5_1").draw(4096, 3), control_error(simulate_loop(well_tuned_loop(), 3)));
  EXPECT_EQ(family("paper_5_4").draw(4096, 3),
            control_error(simulate_loop(sticking_loop(StictionLaw::choudhury), 3)));
}

TEST(CalibrationFamilies, PowerLiesWhereTheNameSays) {
  for (const double period : {20.0, 300.0}) {
    const auto signal =
        family(period == 20.0 ? "sinusoid_20_at_0_db" : "sinusoid_300_at_0_db").draw(65'536, 1);
    EXPECT_GT(tests::power_at(signal, 1.0 / period), 50.0 * tests::power_at(signal, 0.3));
    EXPECT_NEAR(tests::variance(signal), 2.0, 0.1) << period;
  }
  EXPECT_NEAR(tests::variance(family("square_64").draw(65'536, 1)), 1.1, 0.03);
  EXPECT_NEAR(tests::variance(family("white_exponential").draw(65'536, 1)), 1.0, 0.06);
}

}  // namespace
}  // namespace loopscope::core::simulate
