#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::core::simulate {

/// What is true of a signal, and so what a test may find.
enum class FamilyKind {
  linear_gaussian,      ///< nothing: every rejection is false
  linear_non_gaussian,  ///< a test of Gaussianity may reject, one of linearity may not
  linear_disturbed,     ///< Gaussian, but not stationary; nothing to find in it all the same
  nonlinear,            ///< every test may reject
};
[[nodiscard]] std::string_view name(FamilyKind kind);

/// Signals of one description, as many as there are seeds: what tests are calibrated on.
struct CalibrationFamily {
  std::string name;         ///< lower case, digits, '_' and '.'
  std::string description;  ///< one line for people
  FamilyKind kind = FamilyKind::linear_gaussian;
  std::size_t samples = 4096;  ///< of a record; NaN among them is missing
  /// The record of a length and a seed; the same seed gives the same record.
  std::function<std::vector<double>(std::size_t samples, std::uint64_t seed)> draw;
};

/// Every family: linear Gaussian (with gaps and short records), non-Gaussian, disturbed; nonlinear.
/// Names are unique.
[[nodiscard]] const std::vector<CalibrationFamily>& calibration_families();

}  // namespace loopscope::core::simulate
