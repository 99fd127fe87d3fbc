#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {

inline constexpr double kNotTested = std::numeric_limits<double>::quiet_NaN();

/// What one loop of a plant brings into the false-discovery control.
struct PlantLoop {
  double p = kNotTested;  ///< of the verdict
  std::string code = "tight_tuning";
  double nonlinear_p = kNotTested;
  double oscillation_p = kNotTested;
  double harris_p = kNotTested;
  double confidence = 1.0;
  int slot_hours = 1;
  bool enabled = true;
};

/// Plants of thousands of loops, written in a few statements instead of through the worker.
class PlantTest : public ResultsTest {
 protected:
  /// Replaces everything; loop k is named k.
  void fill(const std::vector<PlantLoop>& loops);
  /// One more analysis of every loop, in the order of the first fill.
  void analyse_again(const std::vector<PlantLoop>& loops);
  /// Which loops are flagged.
  [[nodiscard]] std::vector<bool> flagged(std::size_t loops) const;
  void set(const std::string& parameter, double value) const;
};

}  // namespace loopscope::storage
