#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/effects/draft.hpp"

namespace loopscope::tests::repairs {

/// Puts a fault of one size into a loop without it; 0 = the smallest that is one, 1 = the largest;
/// the parameters lie on a logarithmic scale between the two.
using PutFault = std::function<void(effects::Scenario&, double size)>;

/// By what a smaller or larger fault is told.
enum class Burden {
  variance,     ///< mean square of the error
  explainable,  ///< what it adds to the one-step error of a linear model (effects/explainable.hpp)
  size,         ///< its parameter: the sensor's, which may leave no other trace
};

struct FaultKind {
  std::string name;
  std::string event_kind;  ///< of the work that is meant to mend it
  std::string work;        ///< in the words of a work order
  effects::LoopOptions options;
  Burden burden = Burden::variance;
  bool is_spread = false;  ///< has to show in the one-step error wherever it is
  /// Draws what does not depend on the size.
  PutFault (*draw)(const effects::Draft& loop, effects::Random& random) = nullptr;
};

/// Every kind that a repair can mend, worsen or leave.
[[nodiscard]] const std::vector<FaultKind>& fault_kinds();

}  // namespace loopscope::tests::repairs
