#pragma once

#include <optional>

#include "core/hos/analyse.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/loop/shape.hpp"
#include "core/loop/valve_gain.hpp"
#include "core/signal/data_quality.hpp"

namespace loopscope::core {

/// Everything measured on one window; what could not be measured is nullopt in its own struct.
struct Evidence {
  signal::DataQuality data_quality;
  std::optional<hos::Result> hos;  ///< nullopt when the data are not usable
  loop::Oscillation oscillation;   ///< of the error
  loop::Performance performance;
  loop::Shape shape;
  loop::ValveGain valve_gain;
  bool integrating = false;  ///< level loop: the vessel integrates (from the catalogue)
};

}  // namespace loopscope::core
