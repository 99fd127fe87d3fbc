#pragma once

#include <string>
#include <vector>

#include "core/repair/repair_windows.hpp"

namespace loopscope::core::repair {

/// One side of a repair as a test wants it; every window is the same.
struct Side {
  std::string code;    ///< "healthy" = no fault
  std::string family;  ///< empty = no fault
  double error_std = 1.0;
  double harris = 0.5;
  double confidence = 0.9;
  std::size_t windows = 2;
  std::vector<EffectParameter> effects = {};
};

inline const Side kSound{"healthy", ""};
inline const Side kSticks{"valve_stiction", "friction"};
inline const Side kTight{"tight_tuning", "oscillation"};

inline std::vector<RepairWindow> windows_of(const Side& side) {
  RepairWindow window;
  window.code = side.code;
  window.family = side.family;
  window.confidence = side.confidence;
  window.error_std = side.error_std;
  window.harris = side.harris;
  window.effects = side.effects;
  return std::vector(side.windows, window);
}

/// With a min_confidence of 0.3.
inline RepairWindows repair_between(const Side& before, const Side& after) {
  return {windows_of(before), windows_of(after), 0.3, "", {}};
}

/// The same with another error.
inline Side with_error(Side side, double error_std, double harris) {
  side.error_std = error_std;
  side.harris = harris;
  return side;
}

inline Side with_confidence(Side side, double confidence) {
  side.confidence = confidence;
  return side;
}

inline Side with_effect(Side side, const EffectParameter& effect) {
  side.effects = {effect};
  return side;
}

}  // namespace loopscope::core::repair
