#pragma once

#include <string>
#include <vector>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {

inline constexpr auto kHealthy = core::diagnosis::VerdictCode::healthy;

/// What a test of the views says about one loop; the rest is ordinary.
struct Story {
  std::string loop;
  core::diagnosis::VerdictCode code = core::diagnosis::VerdictCode::valve_stiction;
  double confidence = 1.0;
  std::optional<double> p = std::nullopt;  ///< of the verdict
  std::optional<double> nonlinear_p = std::nullopt;
  std::optional<double> oscillation_p = std::nullopt;
  std::optional<double> harris = std::nullopt;  ///< both ends of the index
  int slot_hours = 1;                           ///< slot end, hours after slot(0)
  double error_std = 1.0;
  bool usable = true;
  /// 1 less the probability of healthy; nullopt = no cause was weighed.
  std::optional<double> fault_probability = std::nullopt;
};

/// Results that went through the program itself.
class ViewsTest : public ResultsTest {
 protected:
  /// Stores one analysis for each story, adding loops that are not there yet.
  void tell(const std::vector<Story>& stories);
  /// First column of a query, as a list.
  [[nodiscard]] std::vector<std::string> column(const std::string& sql) const;
  [[nodiscard]] std::vector<std::string> flagged() const {
    return column("SELECT loop_name FROM loopscope.flagged_loop ORDER BY rank");
  }
};

}  // namespace loopscope::storage
