#pragma once

#include <cstddef>
#include <optional>

#include "core/hos/analyse.hpp"
#include "core/hos/slow_look.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/loop/shape.hpp"
#include "core/loop/valve_gain.hpp"
#include "core/model/explanation.hpp"
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
  /// The same statistics on data resampled to fit a slow oscillation; nullopt when none is needed
  /// or too little is recorded.
  std::optional<hos::SlowLook> hos_slow;
  /// Samples up to the window's end that the slow look wants; 0 = the window is long enough, or no
  /// slow look is needed.
  std::size_t slow_span_samples = 0;
  /// The fitted loop model's story; nullopt = switched off, no op, or data not usable.
  std::optional<model::Explanation> model;
};

}  // namespace loopscope::core
