#pragma once

#include <string_view>
#include <vector>

#include "core/simulate/calibration_families.hpp"

namespace loopscope::core::hos::tests {

/// Shares of the records of a family whose p-value is at most a level.
struct FamilyRates {
  double ngi = 0.0;
  double nli = 0.0;
  double cubic = 0.0;  ///< of all records; one without a cubic p counts as 1
  double nonlinear = 0.0;
};

/// The p-values of `records` records of a family.
struct FamilyPValues {
  std::vector<double> ngi, nli, cubic, nonlinear;
  [[nodiscard]] FamilyRates at(double level) const;
};
[[nodiscard]] FamilyPValues p_values(const simulate::CalibrationFamily& family, int records);

/// By its name; throws std::out_of_range for one that is not there.
[[nodiscard]] const simulate::CalibrationFamily& family(std::string_view name);

/// A row of a table of rates at 5 %, 1 % and 0.1 %, to standard output.
void print_row(std::string_view name, const FamilyPValues& p);

}  // namespace loopscope::core::hos::tests
