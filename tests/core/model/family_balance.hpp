#pragma once

#include <array>

namespace loopscope::tests::model {

/// Shares judged right, every family counted once.
struct FamilyBalance {
  std::array<double, 2> sum{};
  std::array<double, 2> families{};
  void add(bool sticks, double right) {
    sum[sticks ? 1 : 0] += right;
    families[sticks ? 1 : 0] += 1.0;
  }
  [[nodiscard]] double specificity() const { return sum[0] / families[0]; }
  [[nodiscard]] double sensitivity() const { return sum[1] / families[1]; }
  [[nodiscard]] double accuracy() const { return 0.5 * (specificity() + sensitivity()); }
};

}  // namespace loopscope::tests::model
